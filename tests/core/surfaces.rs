//! The relief as files: what is written is the mesh, and lies where the formats say.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::file::{glb, ply};
use relievo::scene::{self, Sequence};
use relievo::view::{self, Mesh, ViewParams};
use serde_json::Value;

/// A still background, so that there are ghosts, and bodies before it, so that something is hidden.
fn relief() -> (Sequence, Mesh) {
    let blocks = scene::render("blocks", 64, 48).unwrap();
    let mesh = view::mesh(&blocks.frames[0], &blocks.truth, &ViewParams::default());
    assert!(mesh.parts.iter().all(|&part| part > 0), "{:?}", mesh.parts);
    (blocks, mesh)
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    (bytes.as_chunks::<4>().0.iter().copied())
        .map(f32::from_le_bytes)
        .collect()
}

/// JSON and numbers of a GLB, its frame having been looked at.
fn opened(bytes: &[u8]) -> (Value, &[u8]) {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(bytes, 4), word(bytes, 8)), (2, bytes.len()));
    let json = word(bytes, 12);
    assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0));
    let binary = 20 + json;
    assert_eq!(&bytes[binary + 4..binary + 8], b"BIN\0");
    assert_eq!(binary + 8 + word(bytes, binary), bytes.len());
    let text = serde_json::from_slice(&bytes[20..binary]).unwrap();
    (text, &bytes[binary + 8..])
}

#[test]
fn glb_holds_the_mesh_and_its_texture() {
    let (blocks, mesh) = relief();
    let frame = &blocks.frames[0].rgb;
    let bytes = glb::write(&mesh, frame).unwrap();
    let (json, binary) = opened(&bytes);
    let number = |value: &Value| value.as_u64().unwrap() as usize;
    let view = |i: &Value| {
        let view = &json["bufferViews"][number(i)];
        let start = number(&view["byteOffset"]);
        assert_eq!(start % 4, 0);
        &binary[start..start + number(&view["byteLength"])]
    };
    let values = |accessor: &Value, kind: u64, size: usize| {
        let accessor = &json["accessors"][number(accessor)];
        let bytes = view(&accessor["bufferView"]);
        assert_eq!(accessor["componentType"], kind);
        assert_eq!(bytes.len(), size * number(&accessor["count"]));
        (accessor.clone(), bytes)
    };
    assert_eq!(number(&json["buffers"][0]["byteLength"]), binary.len());

    let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 3);
    let mut indices = Vec::new();
    for (i, primitive) in primitives.iter().enumerate() {
        assert_eq!(primitive["material"], i);
        let attributes = &primitive["attributes"];
        let (position, bytes) = values(&attributes["POSITION"], 5126, 12);
        assert_eq!(floats(bytes), mesh.positions);
        for (axis, z) in [(0, "min"), (1, "max"), (2, "max")] {
            let along = mesh.positions.iter().skip(axis).step_by(3).copied();
            let bound = along.reduce(if z == "min" { f32::min } else { f32::max });
            assert_eq!(position[z][axis].as_f64(), bound.map(f64::from));
        }
        assert_eq!(
            floats(values(&attributes["NORMAL"], 5126, 12).1),
            mesh.normals
        );
        let (_, bytes) = values(&primitive["indices"], 5125, 4);
        indices.extend((0..bytes.len()).step_by(4).map(|at| word(bytes, at) as u32));
    }
    assert_eq!(indices, mesh.indices);

    // The texture's pixel at a vertex is the frame's, its first row at the top.
    let image = view(&json["images"][0]["bufferView"]);
    let texture = image::load_from_memory(image).unwrap().into_rgb8();
    assert_eq!(texture.as_raw(), frame.data().as_flattened());
    let (_, bytes) = values(&primitives[0]["attributes"]["TEXCOORD_0"], 5126, 8);
    let places = floats(bytes);
    assert!(
        places[0] * 64.0 < 1.0 && places[1] * 48.0 < 1.0,
        "{:?}",
        &places[..2]
    );

    // Colours are linear: half of sRGB's range is a fifth of the light.
    let (colours, bytes) = values(&primitives[1]["attributes"]["COLOR_0"], 5123, 8);
    assert_eq!(colours["normalized"], true);
    for (i, srgb) in mesh.colours.iter().enumerate() {
        let at = 8 * (i / 3) + 2 * (i % 3);
        let light = f32::from(u16::from_le_bytes([bytes[at], bytes[at + 1]])) / 65535.0;
        assert_eq!(view::encode(light), *srgb);
    }
}

#[test]
fn ply_holds_what_is_known_with_its_colours() {
    let (_, mesh) = relief();
    let bytes = ply::write(&mesh);
    let end = b"end_header\n";
    let data = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = std::str::from_utf8(&bytes[..data]).unwrap();
    let count = |what: &str| -> usize {
        let line = header.lines().find(|line| line.starts_with(what)).unwrap();
        line[what.len()..].trim().parse().unwrap()
    };
    let (vertices, faces) = (count("element vertex"), count("element face"));
    let corners = &mesh.indices[..(mesh.parts[0] + mesh.parts[1]) as usize];
    assert_eq!(3 * faces, corners.len());
    assert_eq!(bytes.len(), data + 27 * vertices + 13 * faces);
    let mut seen = vec![false; vertices];
    for (face, own) in corners.chunks(3).enumerate() {
        let at = data + 27 * vertices + 13 * face;
        assert_eq!(bytes[at], 3);
        for (k, &corner) in own.iter().enumerate() {
            let vertex = word(&bytes, at + 1 + 4 * k);
            seen[vertex] = true;
            let at = data + 27 * vertex;
            let three = 3 * corner as usize..3 * corner as usize + 3;
            assert_eq!(floats(&bytes[at..at + 12]), mesh.positions[three.clone()]);
            assert_eq!(
                floats(&bytes[at + 12..at + 24]),
                mesh.normals[three.clone()]
            );
            assert_eq!(bytes[at + 24..at + 27], mesh.colours[three]);
        }
    }
    assert!(seen.iter().all(|&used| used), "vertices without a face");
}
