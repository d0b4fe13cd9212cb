//! Meshes that are closed, open, inside out, and their words.

use super::*;

/// A cube of half size 1 around (3, 0, 0), counter-clockwise from outside, each face with vertices of its own.
fn cube() -> Surface {
    let mut surface = Surface::default();
    for axis in 0..3 {
        for side in [-1.0f32, 1.0] {
            let corner = |u: f32, v: f32| {
                let mut p = [0.0; 3];
                p[axis] = side;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v * side;
                p[0] += 3.0;
                p
            };
            let face = [
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ];
            surface.add(&face, &[[0, 1, 2], [0, 2, 3]]).unwrap();
        }
    }
    surface
}

#[test]
fn equal_vertices_are_one() {
    let checked = cube().checked().unwrap();
    assert_eq!(checked.vertices.len(), 8);
    assert_eq!(checked.triangles.len(), 12);
}

#[test]
fn an_open_mesh_is_refused() {
    let mut open = cube();
    open.triangles.pop();
    let reason = open.checked().unwrap_err();
    assert!(reason.contains("not closed: 3 of its edges"), "{reason}");
    assert!(
        Surface::default()
            .checked()
            .unwrap_err()
            .contains("no triangles")
    );
}

#[test]
fn a_vertex_that_is_not_there_is_refused() {
    let mut surface = Surface::default();
    assert!(surface.add(&[[0.0; 3]], &[[0, 0, 1]]).is_err());
}

#[test]
fn a_mesh_fits_the_unit_box_and_is_turned_outwards() {
    let fitted = cube().checked().unwrap().fitted();
    let all = fitted.vertices.as_flattened();
    assert!(all.iter().all(|x| x.abs() == 1.0), "{all:?}");
    let mut inward = cube();
    inward.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let turned = inward.checked().unwrap().fitted();
    let normal = |s: &Surface| {
        let [a, b, c] = s.triangles[0].map(|v| glam::Vec3::from(s.vertices[v as usize]));
        (b - a).cross(c - a).dot(a)
    };
    assert!(normal(&fitted) > 0.0 && normal(&turned) > 0.0);
}

#[test]
fn the_words_hold_a_hierarchy_that_covers_all_triangles_once() {
    let words = bvh::packed(&cube().checked().unwrap().fitted());
    let [nodes, triangles, vertices, _] = words[0].map(|w| w as usize);
    assert_eq!((triangles, words.len()), (12, vertices + 8));
    let mut seen = vec![0; triangles];
    for node in 0..nodes {
        let (low, high) = (words[1 + 2 * node], words[2 + 2 * node]);
        assert!(low[3] as usize > node && low[3] as usize <= nodes);
        let (first, count) = (high[3] >> 4, high[3] & 15);
        for triangle in first..first + count {
            seen[triangle as usize] += 1;
            for vertex in &words[1 + 2 * nodes + triangle as usize][..3] {
                let p = words[vertices + *vertex as usize];
                let inside = |k: usize| {
                    let x = f32::from_bits(p[k]);
                    f32::from_bits(low[k]) < x && x < f32::from_bits(high[k])
                };
                assert!((0..3).all(inside));
            }
        }
    }
    assert!(seen.iter().all(|&n| n == 1), "{seen:?}");
}

#[test]
fn files_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tetrahedron.obj");
    std::fs::write(
        &path,
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .unwrap();
    assert_eq!(load(&path).unwrap()[0][1], 4);
    let told = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        load(&path).unwrap_err().to_string()
    };
    assert!(told("a.stl", "").contains("not a format of meshes"));
    assert!(told("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").contains("not closed"));
    assert!(told("c.obj", "v 0 0 0\nf 1 2 9\n").contains("mesh"));
    assert!(told("d.gltf", "{").contains("mesh"));
}

/// A tetrahedron whose apex is 2 above the ground in y, which is up in glTF; its node turns nothing, or mirrors x.
fn tetrahedron(scale: f32) -> Vec<[u32; 4]> {
    use base64::Engine as _;
    let positions = [
        [0.0f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let numbers = [0u16, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
    let mut bytes: Vec<u8> = positions
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    bytes.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"scale":[{scale},1,1]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "buffers":[{{"byteLength":72,"uri":"data:application/octet-stream;base64,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,2,1]}},
        {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}]}}"#
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.gltf");
    std::fs::write(&path, text).unwrap();
    load(&path).unwrap()
}

#[test]
fn gltf_is_read_with_y_up_and_nodes_in_place() {
    for scale in [1.0, -1.0] {
        let words = tetrahedron(scale);
        let [_, triangles, vertices, _] = words[0].map(|w| w as usize);
        assert_eq!((triangles, words.len()), (4, vertices + 4));
        let apex = words[vertices + 2].map(f32::from_bits);
        // the height fills the box, half as much is left for x, whose least or greatest end the apex is at
        assert!(
            (apex[2] - 1.0).abs() < 1e-6 && (apex[0] + 0.5 * scale).abs() < 1e-6,
            "{apex:?}"
        );
    }
}
