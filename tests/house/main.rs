//! How the workspace is built: short files and functions, imports from the bottom up.

mod imports;
mod limits;
