//! glTF 2.0: .gltf with buffers beside or in it, and .glb.

use std::path::Path;

use base64::Engine as _;
use glam::Mat4;
use gltf::buffer::Source;
use gltf::mesh::Mode;

use super::Surface;

/// Deepest nesting of nodes.
const MAX_DEPTH: usize = 64;

/// All triangles of the default scene, or of the first, in its coordinates. Y is up there; z is up here.
pub(super) fn read(path: &Path) -> Result<Surface, String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let file = gltf::Gltf::from_slice(&bytes).map_err(|error| error.to_string())?;
    let buffers = buffers(&file, path)?;
    let scene = file
        .default_scene()
        .or_else(|| file.scenes().next())
        .ok_or("there is no scene in it")?;
    let upright = Mat4::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let mut surface = Surface::default();
    for node in scene.nodes() {
        add_node(&node, upright, &buffers, &mut surface, 0)?;
    }
    Ok(surface)
}

fn add_node(
    node: &gltf::Node,
    above: Mat4,
    buffers: &[Vec<u8>],
    surface: &mut Surface,
    depth: usize,
) -> Result<(), String> {
    if depth > MAX_DEPTH {
        return Err(format!("nodes nest deeper than {MAX_DEPTH}"));
    }
    let place = above * Mat4::from_cols_array_2d(&node.transform().matrix());
    for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
        if primitive.mode() != Mode::Triangles {
            continue;
        }
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(Vec::as_slice));
        let positions = reader.read_positions().ok_or("a mesh has no positions")?;
        let vertices: Vec<[f32; 3]> = positions
            .map(|p| place.transform_point3(p.into()).to_array())
            .collect();
        let numbers: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..vertices.len() as u32).collect(),
        };
        let mut triangles = numbers.as_chunks().0.to_vec();
        if place.determinant() < 0.0 {
            triangles
                .iter_mut()
                .for_each(|t: &mut [u32; 3]| t.swap(1, 2));
        }
        surface.add(&vertices, &triangles)?;
    }
    for child in node.children() {
        add_node(&child, place, buffers, surface, depth + 1)?;
    }
    Ok(())
}

fn buffers(file: &gltf::Gltf, path: &Path) -> Result<Vec<Vec<u8>>, String> {
    let bytes = |source: Source| match source {
        Source::Bin => file
            .blob
            .clone()
            .ok_or("the binary part is missing".to_owned()),
        Source::Uri(uri) => match uri.strip_prefix("data:") {
            Some(data) => {
                let (_, text) = data
                    .split_once(";base64,")
                    .ok_or("a buffer is not in base64")?;
                base64::engine::general_purpose::STANDARD
                    .decode(text)
                    .map_err(|error| format!("a buffer: {error}"))
            }
            None => beside(path, uri),
        },
    };
    file.buffers()
        .map(|buffer| {
            let bytes = bytes(buffer.source())?;
            if bytes.len() < buffer.length() {
                let (found, wanted) = (bytes.len(), buffer.length());
                return Err(format!("a buffer has {found} bytes of {wanted}"));
            }
            Ok(bytes)
        })
        .collect()
}

/// A file in the same folder: a name alone, since a file from elsewhere must not reach for others.
fn beside(path: &Path, name: &str) -> Result<Vec<u8>, String> {
    if Path::new(name).file_name() != Some(name.as_ref()) {
        return Err(format!("its buffer `{name}` is not a file beside it"));
    }
    std::fs::read(path.with_file_name(name)).map_err(|error| format!("`{name}`: {error}"))
}
