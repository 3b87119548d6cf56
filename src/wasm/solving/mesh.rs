//! The relief as lists for a graphics card.

use js_sys::{Float32Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::view;

/// A surface of triangles, cut along the curves: x right, y up, z towards the viewer, in a box of about
/// −1 to 1.
#[wasm_bindgen]
pub struct Mesh(pub(super) view::Mesh);

#[wasm_bindgen]
impl Mesh {
    /// x, y, z of each vertex.
    #[wasm_bindgen(getter, unchecked_return_type = "Float32Array<ArrayBuffer>")]
    pub fn positions(&self) -> Float32Array {
        Float32Array::from(self.0.positions.as_slice())
    }

    /// Unit normal of each vertex.
    #[wasm_bindgen(getter, unchecked_return_type = "Float32Array<ArrayBuffer>")]
    pub fn normals(&self) -> Float32Array {
        Float32Array::from(self.0.normals.as_slice())
    }

    /// Place of each vertex in the frame, 0–1 from the lower left corner.
    #[wasm_bindgen(getter, unchecked_return_type = "Float32Array<ArrayBuffer>")]
    pub fn uvs(&self) -> Float32Array {
        Float32Array::from(self.0.uvs.as_slice())
    }

    /// sRGB of each vertex, three bytes, greyed where depth is not known, guessed and darker where it is hidden.
    #[wasm_bindgen(getter, unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn colours(&self) -> Uint8Array {
        Uint8Array::from(self.0.colours.as_slice())
    }

    /// Region of each vertex.
    #[wasm_bindgen(getter, unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn labels(&self) -> Uint8Array {
        Uint8Array::from(self.0.labels.as_slice())
    }

    /// 1 where depth was observable in the vertex's region, 0 where it is drawn flat.
    #[wasm_bindgen(getter, unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn known(&self) -> Uint8Array {
        Uint8Array::from(self.0.known.as_slice())
    }

    /// Three vertices for each triangle, counter-clockwise seen from the front.
    #[wasm_bindgen(getter, unchecked_return_type = "Uint32Array<ArrayBuffer>")]
    pub fn indices(&self) -> Uint32Array {
        Uint32Array::from(self.0.indices.as_slice())
    }

    /// How many of the indices, in this order, are of what is seen at a known depth, of what goes on hidden behind it,
    /// and of what is seen at an unknown depth.
    #[wasm_bindgen(getter, unchecked_return_type = "Uint32Array<ArrayBuffer>")]
    pub fn parts(&self) -> Uint32Array {
        Uint32Array::from(self.0.parts.as_slice())
    }

    /// The factor that its depth is multiplied by: that of the view's parameters, or the one that was chosen.
    #[wasm_bindgen(getter)]
    pub fn deepened(&self) -> f32 {
        self.0.deepened
    }
}
