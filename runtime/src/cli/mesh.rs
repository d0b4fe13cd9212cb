//! `--mesh`: the solid of a scene whose shape is one.

use std::path::Path;

use pullback_compiler::{SceneModule, SettingValue};
use pullback_runtime::mesh;

use super::failure::Failure;

/// Gives a scene its mesh, if its settings want one.
pub(super) fn furnish(
    scene: &mut SceneModule,
    settings: &[SettingValue],
    file: Option<&Path>,
) -> Result<(), Failure> {
    let shape = settings.iter().find(|s| s.spec.name == "shape");
    let wanted = shape.and_then(SettingValue::word) == Some("mesh");
    match (wanted, file) {
        (true, Some(file)) => scene.mesh = mesh::load(file).map_err(Failure::writing("mesh"))?,
        (true, None) => {
            return Err(Failure::usage_hint(
                "`shape = mesh` needs the file of a mesh",
                "give --mesh FILE, an .obj, .gltf or .glb file",
            ));
        }
        (false, Some(_)) => {
            return Err(Failure::usage_hint(
                "no solid of this scene has the shape of a mesh",
                "use `show additive(f) { shape = mesh }`, or leave --mesh out",
            ));
        }
        (false, None) => {}
    }
    Ok(())
}
