//! The pictures of the benchmark, and the shaders that draw them.

use naga::Module;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use pullback_compiler::link::{Linker, Provider, Sources, parse_wgsl};
use pullback_compiler::lower::{LowerError, Precision, Tier};
use pullback_compiler::scene::Space;
use pullback_compiler::{Picture, SceneModule, compile};

use crate::stage::Uniforms;

/// One formula of the gallery with its twin.
pub struct Case {
    pub name: &'static str,
    text: &'static str,
    /// `f` by hand.
    formula: &'static str,
    methods: &'static [Method],
}

/// A hand-written way to fill in a scene's stubs from `f`.
struct Method {
    name: &'static str,
    text: &'static str,
}

const LEVELS: &[Method] = &[Method {
    name: "twin",
    text: include_str!("../twins/levels.wgsl"),
}];
const DOMAIN: &[Method] = &[Method {
    name: "twin",
    text: include_str!("../twins/domain.wgsl"),
}];
const SURFACE: &[Method] = &[
    Method {
        name: "twin",
        text: include_str!("../twins/surface.wgsl"),
    },
    Method {
        name: "signs",
        text: include_str!("../twins/surface-signs.wgsl"),
    },
];

macro_rules! case {
    ($name:literal, $methods:expr) => {
        Case {
            name: $name,
            text: include_str!(concat!("../../../docs/gallery/", $name, ".pull")),
            formula: include_str!(concat!("../twins/", $name, ".wgsl")),
            methods: $methods,
        }
    };
}

pub const CASES: &[Case] = &[
    case!("sin-rings", LEVELS),
    case!("tangent-weave", LEVELS),
    case!("chladni", LEVELS),
    case!("rational", DOMAIN),
    case!("essential", DOMAIN),
    case!("z-to-z", DOMAIN),
    case!("schwarz-p", SURFACE),
    case!("clebsch", SURFACE),
    case!("barth-sextic", SURFACE),
    case!("mandelbrot", LEVELS),
    case!("newton-basins", DOMAIN),
    case!("mandelbulb", SURFACE),
    case!("pebble", SURFACE),
];

/// The name that the hand-written shader all others are compared with has among the [`Shader`]s.
pub const TWIN: &str = "twin";

/// A case, ready to be drawn.
pub struct Prepared {
    pub scene: &'static str,
    pub shaders: Vec<Shader>,
    pub uniforms: Uniforms,
}

pub struct Shader {
    pub name: &'static str,
    pub module: Module,
    pub info: ModuleInfo,
}

impl Case {
    /// Compiles the formula, and links the twins with the same template.
    pub fn prepare(&self) -> Result<Prepared, String> {
        let program = compile(self.text).program.ok_or("the formula has errors")?;
        let picture = &program.pictures()[0];
        let ours = |precision| SceneModule::new(picture, precision).map_err(|e| format!("{e:?}"));
        let accurate = ours(Precision::Accurate)?;
        let fast = ours(Precision::Fast)?;
        let settings = accurate.pack_settings(&picture.settings);
        let mut shaders = vec![
            Shader {
                name: "accurate",
                module: accurate.module,
                info: accurate.info,
            },
            Shader {
                name: "fast",
                module: fast.module,
                info: fast.info,
            },
        ];
        for method in self.methods {
            let (module, info) = twin(picture, &[method.text, self.formula].concat())?;
            shaders.push(Shader {
                name: method.name,
                module,
                info,
            });
        }
        let [x, y, _] = picture.setting("center").unwrap_or_default().to_array();
        let plane = picture.scene.space != Space::Space;
        Ok(Prepared {
            scene: picture.scene.name,
            shaders,
            uniforms: Uniforms {
                settings,
                params: program.params().iter().map(|p| p.default).collect(),
                center: if plane { [x, y] } else { [0.0; 2] },
                height: picture.setting("height").map_or(2.0, |h| h.x),
            },
        })
    }
}

/// The picture's scene with functions of a hand-written text in place of its stubs.
fn twin(picture: &Picture, text: &str) -> Result<(Module, ModuleInfo), String> {
    /// Nothing is generated.
    struct ByHand;
    impl Provider for ByHand {
        fn provide(
            &mut self,
            _: &str,
            _: &naga::Function,
            _: &mut Linker,
        ) -> Result<Option<naga::Function>, LowerError> {
            Ok(None)
        }
    }
    let (by_hand, error) = parse_wgsl(text);
    if let Some(error) = error {
        return Err(error);
    }
    let Sources {
        entry,
        shared,
        math,
    } = Sources::get(Tier::default());
    let sources = vec![picture.scene.module(), &by_hand, entry, shared, math];
    let mut linker = Linker::new(sources);
    linker
        .link_entry_points(2, &mut ByHand)
        .map_err(|e| format!("{e:?}"))?;
    let mut module = linker.out;
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|e| format!("{e:?}"))?;
    Ok((module, info))
}
