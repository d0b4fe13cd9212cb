//! The reference against the 60-digit tables and against Annex G; the shader library through naga.

mod hash;
mod oracle;
mod shaders;
mod special;
