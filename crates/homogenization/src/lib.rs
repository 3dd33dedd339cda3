//! homogenization
