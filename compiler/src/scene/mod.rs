//! Scenes: a WGSL template and a settings record each.

mod additive;
mod bands;
mod camera;
mod checker;
mod colour_map;
mod combination;
mod cutaway;
mod domain;
mod glow;
mod grid;
mod implicit;
mod levels;
mod logcontours;
mod nested;
mod scatter;
mod setting;
mod slices;
mod space;
mod sphere;
mod surface;
mod twilight;
mod volume;
mod volumecut;

use std::sync::OnceLock;

use naga::Module;
use rustc_hash::FxHashMap;

pub use colour_map::{ENTRIES, TABLE, Table, colour_map, setting_component};
pub use combination::{Conflict, conflicts};
pub use setting::{SettingKind, SettingSpec};

use crate::link::parse_wgsl;

/// What a scene is a picture of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Space {
    /// A real function of x and y.
    Plane,
    /// A complex function of one complex variable.
    Complex,
    /// A real function of x, y and z.
    Space,
}

/// A kind of picture.
#[derive(Debug)]
pub struct Scene {
    /// Its name after `show`.
    pub name: &'static str,
    /// One line: what it shows.
    pub doc: &'static str,
    /// What it is a picture of.
    pub space: Space,
    /// Its template.
    pub template: &'static str,
    /// Its settings.
    pub settings: &'static [SettingSpec],
}

/// Every scene.
#[must_use]
pub fn scenes() -> &'static [Scene] {
    static SCENES: [Scene; 17] = [
        levels::SCENE,
        logcontours::SCENE,
        bands::SCENE,
        implicit::SCENE,
        domain::SCENE,
        checker::SCENE,
        grid::SCENE,
        sphere::SCENE,
        surface::SCENE,
        slices::SCENE,
        nested::SCENE,
        cutaway::SCENE,
        volume::SCENE,
        volumecut::SCENE,
        scatter::SCENE,
        glow::SCENE,
        additive::SCENE,
    ];
    &SCENES
}

/// The scene of this name.
#[must_use]
pub fn scene(name: &str) -> Option<&'static Scene> {
    scenes().iter().find(|s| s.name == name)
}

/// The scene that shows a function when none is named.
#[must_use]
pub fn default_scene(space: Space) -> &'static Scene {
    scenes()
        .iter()
        .find(|s| s.space == space)
        .unwrap_or(&scenes()[0])
}

impl Scene {
    /// The parsed template; parsed once per process.
    #[must_use]
    pub fn module(&self) -> &'static Module {
        static MODULES: OnceLock<FxHashMap<&'static str, Module>> = OnceLock::new();
        let modules = MODULES.get_or_init(|| {
            scenes()
                .iter()
                .map(|s| (s.name, parse_wgsl(s.template).0))
                .collect()
        });
        // every scene is in the map
        modules
            .get(self.name)
            .unwrap_or_else(|| crate::link::entry_module())
    }

    /// The setting of this name.
    #[must_use]
    pub fn setting(&self, name: &str) -> Option<&'static SettingSpec> {
        self.settings.iter().find(|s| s.name == name)
    }
}
