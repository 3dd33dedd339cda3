//! winding
