//! Edits in curvature space.
