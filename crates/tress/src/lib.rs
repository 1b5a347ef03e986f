//! Editing coiled hair in curvature space: the facade.
