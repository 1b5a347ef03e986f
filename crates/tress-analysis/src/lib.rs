//! What the curvatures of a groom say: coil radius, pitch, handedness, turns, clusters.
