//! The bytes of the uniform buffers that every shader module shares.

use pullback_compiler::lower::Format;

/// Number of user parameters that fit the uniform `params: array<vec4f, 16>`.
pub(crate) const MAX_PARAMS: usize = 64;

/// `struct View` of the scene shaders.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct ViewUniform {
    /// World coordinates of the centre of the whole image.
    pub center: [f32; 2],
    /// The whole image in pixels.
    pub size: [f32; 2],
    /// Pixel of the whole image at the tile's top-left corner.
    pub tile: [f32; 2],
    /// World units per pixel.
    pub pixel: f32,
    /// Seconds.
    pub time: f32,
    /// Supersamples per axis.
    pub samples: u32,
    /// Zero, which the shader compiler must not know.
    pub zero: u32,
    /// This tile in pixels.
    pub tile_size: [u32; 2],
}

/// `struct Batch` of the evaluation shaders.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct BatchUniform {
    /// Rows in this batch.
    pub count: u32,
    /// Zero, which the shader compiler must not know.
    pub zero: u32,
    /// Seconds.
    pub time: f32,
    /// World units per pixel.
    pub pixel: f32,
    /// Numbers in a row.
    pub columns: u32,
    /// Numbers in a result.
    pub results: u32,
}

/// `struct Wide` of the wide libraries: numbers in all digits of the tier, two words each.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct WideWords {
    /// World coordinates of the view's centre.
    pub center: [[u32; 2]; 2],
    /// Seconds, and world units per pixel.
    pub clock: [[u32; 2]; 2],
    /// The program's parameters.
    pub params: [[u32; 2]; MAX_PARAMS],
}

impl WideWords {
    /// The numbers in a format; parameters beyond those given are zero.
    pub(crate) fn new(
        format: Format,
        center: [f64; 2],
        time: f64,
        pixel: f64,
        params: &[f64],
    ) -> Self {
        let mut all = [[0; 2]; MAX_PARAMS];
        for (slot, &value) in all.iter_mut().zip(params) {
            *slot = format.words(value);
        }
        Self {
            center: center.map(|x| format.words(x)),
            clock: [time, pixel].map(|x| format.words(x)),
            params: all,
        }
    }
}

/// The parameters in the order of the program, zero beyond them.
pub(crate) fn params(values: &[f64]) -> [f32; MAX_PARAMS] {
    let mut all = [0.0; MAX_PARAMS];
    for (slot, &value) in all.iter_mut().zip(values) {
        *slot = value as f32;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layouts_agree_with_wgsl() {
        let module = naga::front::wgsl::parse_str(
            "struct View { center: vec2f, size: vec2f, tile: vec2f, pixel: f32, time: f32,
                           samples: u32, zero: u32, tile_size: vec2u }
             struct Batch { count: u32, zero: u32, time: f32, pixel: f32, columns: u32, results: u32 }
             struct Wide { center: vec4u, clock: vec4u, params: array<vec4u, 32> }",
        )
        .unwrap();
        let size = |name: &str| {
            let (_, ty) = module
                .types
                .iter()
                .find(|(_, ty)| ty.name.as_deref() == Some(name))
                .unwrap();
            ty.inner.size(module.to_ctx()) as usize
        };
        assert_eq!(size("View"), size_of::<ViewUniform>());
        assert_eq!(size("Batch"), size_of::<BatchUniform>());
        assert_eq!(size("Wide"), size_of::<WideWords>());
    }

    #[test]
    fn params_are_padded() {
        let all = params(&[1.5, -2.0]);
        assert_eq!(all[..3], [1.5, -2.0, 0.0]);
        assert_eq!(params(&[1.0; 100])[63], 1.0);
    }
}
