//! A bounding volume hierarchy, and how a mesh is packed with it.

use glam::Vec3;

use super::Surface;

/// Most triangles of a leaf; the shader's words have room for 15.
const LEAF: usize = 4;
/// How much boxes are larger than what they enclose, in a mesh of half size 1: more than a ray of the shader is off.
const MARGIN: f32 = 2e-5;

struct Node {
    low: Vec3,
    high: Vec3,
    /// The node after all beneath.
    next: u32,
    first: u32,
    count: u32,
}

/// The words that `shaders/shared/mesh.wgsl` describes.
pub(super) fn packed(surface: &Surface) -> Vec<[u32; 4]> {
    let corners = |t: &[u32; 3]| t.map(|v| Vec3::from(surface.vertices[v as usize]));
    let mut triangles = surface.triangles.clone();
    let nodes = hierarchy(&mut triangles, &corners);
    let vertices = 1 + 2 * nodes.len() + triangles.len();
    let mut words = vec![[
        nodes.len() as u32,
        triangles.len() as u32,
        vertices as u32,
        0,
    ]];
    for node in &nodes {
        words.push(with(node.low - MARGIN, node.next));
        words.push(with(node.high + MARGIN, node.first << 4 | node.count));
    }
    words.extend(triangles.iter().map(|&[a, b, c]| [a, b, c, 0]));
    words.extend(surface.vertices.iter().map(|&p| with(p.into(), 0)));
    words
}

fn with(p: Vec3, word: u32) -> [u32; 4] {
    let [x, y, z] = p.to_array().map(f32::to_bits);
    [x, y, z, word]
}

/// Nodes in depth-first order; puts the triangles into the order of the leaves. Each node is split in the middle of its triangles
/// along its longest side.
fn hierarchy(triangles: &mut [[u32; 3]], corners: &dyn Fn(&[u32; 3]) -> [Vec3; 3]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::new();
    // ranges to do, and nodes whose subtree ends before them
    let mut stack = vec![Work::Split(0, triangles.len())];
    while let Some(work) = stack.pop() {
        match work {
            Work::End(node) => nodes[node].next = nodes.len() as u32,
            Work::Split(start, end) => {
                let range = &mut triangles[start..end];
                let (low, high) = bounds(range, corners);
                let leaf = range.len() <= LEAF;
                stack.push(Work::End(nodes.len()));
                nodes.push(Node {
                    low,
                    high,
                    next: 0,
                    first: start as u32,
                    count: if leaf { range.len() as u32 } else { 0 },
                });
                if !leaf {
                    let axis = (high - low).max_position();
                    let middle = range.len() / 2;
                    range.select_nth_unstable_by(middle, |a, b| {
                        let at = |t| corners(t).iter().map(|p| p[axis]).sum::<f32>();
                        at(a).total_cmp(&at(b))
                    });
                    stack.push(Work::Split(start + middle, end));
                    stack.push(Work::Split(start, start + middle));
                }
            }
        }
    }
    nodes
}

enum Work {
    Split(usize, usize),
    End(usize),
}

fn bounds(triangles: &[[u32; 3]], corners: &dyn Fn(&[u32; 3]) -> [Vec3; 3]) -> (Vec3, Vec3) {
    let points = triangles.iter().flat_map(corners);
    points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    })
}
