//! Random mechanisms.
