//! Sculpting: super-helices moved to anchors by optimisation.
