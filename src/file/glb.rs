//! The relief as glTF 2.0 in one binary file (GLB), which 3-D programs, browsers and headsets open.
//!
//! A header, then two chunks: JSON that says what there is, and the numbers it speaks of, little-endian. Axes are those
//! of [`Mesh`] and of glTF alike: x right, y up, z towards the viewer; units are arbitrary. Three pieces with a material
//! each share their vertices: what is seen, under the first frame as its texture; what goes on hidden behind it, in
//! colours of its own; what is of unknown depth, as a ghost.
//!
//! Source: Khronos Group, glTF 2.0 Specification.

use serde_json::{Value, json};

use super::png;
use crate::error::Error;
use crate::grid::Grid;
use crate::srgb;
use crate::view::Mesh;

/// Which of [`Mesh::parts`] has colours of its own.
const HIDDEN: usize = 1;

/// What is the same in every file. Surfaces are matt, and what is of unknown depth is seen through; the texture is
/// sampled linearly, with mipmaps, and not repeated at the frame's border.
const SCENE: &str = r#"{
    "asset": { "version": "2.0", "generator": "Relievo" },
    "scene": 0,
    "scenes": [{ "nodes": [0] }],
    "nodes": [{ "name": "relief", "mesh": 0 }],
    "meshes": [{ "name": "relief" }],
    "materials": [
        {
            "name": "seen",
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": 0 },
                "metallicFactor": 0,
                "roughnessFactor": 0.92
            }
        },
        {
            "name": "hidden behind",
            "doubleSided": true,
            "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0.92 }
        },
        {
            "name": "of unknown depth",
            "doubleSided": true,
            "alphaMode": "BLEND",
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": 0 },
                "baseColorFactor": [1, 1, 1, 0.22],
                "metallicFactor": 0,
                "roughnessFactor": 0.92
            }
        }
    ],
    "textures": [{ "source": 0, "sampler": 0 }],
    "samplers": [{ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071 }],
    "images": [{ "name": "frame", "mimeType": "image/png" }],
    "buffers": [{}]
}"#;

// What glTF calls types of numbers and targets of buffers.
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The bytes of the file: `mesh` with `texture`, the picture that its `uvs` speak of.
///
/// ```
/// use relievo::file::glb;
/// use relievo::scene;
/// use relievo::view::{self, ViewParams};
///
/// let flight = scene::render("flight", 64, 48)?;
/// let frame = &flight.frames[0];
/// let mesh = view::mesh(frame, &flight.truth, &ViewParams::default());
/// let bytes = glb::write(&mesh, &frame.rgb)?;
/// assert!(bytes.starts_with(b"glTF"));
/// # Ok::<(), relievo::Error>(())
/// ```
///
/// # Errors
/// [`Error::File`] for a texture without pixels.
pub fn write(mesh: &Mesh, texture: &Grid<[u8; 3]>) -> Result<Vec<u8>, Error> {
    let mut file = File::default();
    let vertices = mesh.labels.len();
    let places = mesh.positions.as_chunks::<3>().0;
    let bound = |of: fn(f32, f32) -> f32, start: f32| -> Vec<f32> {
        let along = |axis: usize| places.iter().map(|p| p[axis]).fold(start, of);
        (0..3).map(along).collect()
    };
    let position = file.numbers(&mesh.positions, "VEC3", vertices);
    file.accessors[position]["min"] = json!(bound(f32::min, f32::INFINITY));
    file.accessors[position]["max"] = json!(bound(f32::max, f32::NEG_INFINITY));
    let normal = file.numbers(&mesh.normals, "VEC3", vertices);
    // glTF counts rows of a texture from the top.
    let down: Vec<f32> = (mesh.uvs.as_chunks::<2>().0.iter())
        .flat_map(|&[u, v]| [u, 1.0 - v])
        .collect();
    let place = file.numbers(&down, "VEC2", vertices);

    let mut primitives = Vec::new();
    let mut rest = mesh.indices.as_slice();
    for (piece, &count) in mesh.parts.iter().enumerate() {
        let (own, others) = rest.split_at(count as usize);
        rest = others;
        if own.is_empty() {
            continue;
        }
        let (looks, which) = match piece {
            HIDDEN => ("COLOR_0", file.colours(&mesh.colours, vertices)),
            _ => ("TEXCOORD_0", place),
        };
        let attributes = json!({ "POSITION": position, "NORMAL": normal, looks: which });
        let bytes: Vec<u8> = own.iter().flat_map(|i| i.to_le_bytes()).collect();
        let indices = file.accessor(&bytes, INDICES, U32, "SCALAR", own.len());
        primitives.push(json!({ "attributes": attributes, "indices": indices, "material": piece }));
    }
    let image = file.view(&png::write_rgb(texture)?, None);
    Ok(file.close(primitives, image))
}

/// What the file is made of so far.
#[derive(Default)]
struct File {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    /// A piece of the binary chunk, at a multiple of four bytes; its number.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view = json!({
            "buffer": 0,
            "byteOffset": self.binary.len(),
            "byteLength": bytes.len(),
        });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.binary.extend(bytes);
        pad(&mut self.binary, 0);
        self.views.push(view);
        self.views.len() - 1
    }

    /// The same as a list of `count` scalars or vectors.
    fn accessor(
        &mut self,
        bytes: &[u8],
        target: u32,
        kind: u32,
        shape: &str,
        count: usize,
    ) -> usize {
        let view = self.view(bytes, Some(target));
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": kind,
            "count": count,
            "type": shape,
        }));
        self.accessors.len() - 1
    }

    fn numbers(&mut self, values: &[f32], shape: &str, count: usize) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(&bytes, VERTICES, F32, shape, count)
    }

    /// sRGB of vertices as glTF wants it: linear, and a multiple of four bytes each.
    fn colours(&mut self, srgb: &[u8], count: usize) -> usize {
        let linear: Vec<u16> = (0..=255u8)
            .map(|byte| (65535.0 * srgb::decode(f64::from(byte) / 255.0)).round() as u16)
            .collect();
        let bytes: Vec<u8> = (srgb.as_chunks::<3>().0.iter())
            .flat_map(|rgb| {
                let [r, g, b] = rgb.map(|byte| linear[usize::from(byte)]);
                [r, g, b, u16::MAX]
            })
            .flat_map(u16::to_le_bytes)
            .collect();
        let number = self.accessor(&bytes, VERTICES, U16, "VEC4", count);
        self.accessors[number]["normalized"] = json!(true);
        number
    }

    fn close(self, primitives: Vec<Value>, image: usize) -> Vec<u8> {
        let mut text: Value = SCENE.parse().expect("it is JSON");
        text["meshes"][0]["primitives"] = primitives.into();
        text["images"][0]["bufferView"] = image.into();
        text["bufferViews"] = self.views.into();
        text["accessors"] = self.accessors.into();
        text["buffers"][0]["byteLength"] = self.binary.len().into();
        let mut text = text.to_string().into_bytes();
        pad(&mut text, b' ');
        let length = 12 + 8 + text.len() + 8 + self.binary.len();
        let mut bytes = Vec::with_capacity(length);
        let word = |bytes: &mut Vec<u8>, n: usize| bytes.extend((n as u32).to_le_bytes());
        bytes.extend(b"glTF");
        word(&mut bytes, 2);
        word(&mut bytes, length);
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.binary)] {
            word(&mut bytes, chunk.len());
            bytes.extend(kind);
            bytes.extend(chunk);
        }
        bytes
    }
}

fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}
