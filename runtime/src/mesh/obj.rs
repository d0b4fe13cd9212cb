//! Wavefront OBJ.

use std::path::Path;

use super::Surface;

/// All shapes of the file. Materials are not read.
pub(super) fn read(path: &Path) -> Result<Surface, String> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut reader = std::io::BufReader::new(file);
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, |_| {
        Ok((Vec::new(), Default::default()))
    })
    .map_err(|error| error.to_string())?;
    let mut surface = Surface::default();
    for model in models {
        surface.add(
            model.mesh.positions.as_chunks().0,
            model.mesh.indices.as_chunks().0,
        )?;
    }
    Ok(surface)
}
