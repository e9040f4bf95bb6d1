//! Bifurcations: branches that cross.
