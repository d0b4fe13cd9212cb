//! Closed meshes of triangles, for the scene `additive`: read from files, checked, and packed for the shader.

mod bvh;
mod gltf;
mod obj;
mod surface;
#[cfg(test)]
mod tests;

use std::path::Path;

use crate::Error;

pub use surface::Surface;

/// Most triangles of a mesh.
pub const MAX_TRIANGLES: usize = 1 << 20;

/// Reads a mesh from an .obj, .gltf or .glb file, and packs it as the words that `shaders/shared/mesh.wgsl` describes: scaled
/// evenly, and moved, so that its box fits -1..1 and touches it.
///
/// # Errors
/// [`Error::Mesh`] if the file cannot be read, has no triangles or too many, or is not closed.
pub fn load(path: &Path) -> Result<Vec<[u32; 4]>, Error> {
    let failed = |reason: String| Error::Mesh {
        path: path.to_owned(),
        reason,
    };
    let surface = read(path).map_err(failed)?;
    Ok(bvh::packed(&surface.checked().map_err(failed)?.fitted()))
}

fn read(path: &Path) -> Result<Surface, String> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    match extension.to_ascii_lowercase().as_str() {
        "obj" => obj::read(path),
        "gltf" | "glb" => gltf::read(path),
        other => Err(format!(
            "`.{other}` is not a format of meshes that is known: give an .obj, .gltf or .glb file"
        )),
    }
}
