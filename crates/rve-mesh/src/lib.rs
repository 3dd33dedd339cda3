//! rve-mesh
