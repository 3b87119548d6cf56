//! The relief as PLY: binary, little-endian, a colour for each vertex and no texture, so that one file is all of it.
//!
//! Axes are those of [`Mesh`]: x right, y up, z towards the viewer; units are arbitrary. PLY knows nothing transparent:
//! what is of unknown depth is left out.
//!
//! Source: G. Turk, The PLY Polygon File Format, 1994.

use crate::view::Mesh;

/// The bytes of the file.
///
/// ```
/// use relievo::file::ply;
/// use relievo::scene;
/// use relievo::view::{self, ViewParams};
///
/// let flight = scene::render("flight", 64, 48)?;
/// let mesh = view::mesh(&flight.frames[0], &flight.truth, &ViewParams::default());
/// assert!(ply::write(&mesh).starts_with(b"ply\n"));
/// # Ok::<(), relievo::Error>(())
/// ```
pub fn write(mesh: &Mesh) -> Vec<u8> {
    let [seen, hidden, _] = mesh.parts;
    let corners = &mesh.indices[..(seen + hidden) as usize];
    // Vertices that no triangle has would show in programs that draw points.
    let mut number = vec![u32::MAX; mesh.labels.len()];
    let mut used = Vec::new();
    for &corner in corners {
        let own = &mut number[corner as usize];
        if *own == u32::MAX {
            *own = used.len() as u32;
            used.push(corner as usize);
        }
    }
    let faces = corners.as_chunks::<3>().0;
    let mut bytes = header(used.len(), faces.len()).into_bytes();
    for &i in &used {
        let three = 3 * i..3 * i + 3;
        for values in [&mesh.positions, &mesh.normals] {
            bytes.extend(values[three.clone()].iter().flat_map(|v| v.to_le_bytes()));
        }
        bytes.extend(&mesh.colours[three]);
    }
    for face in faces {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|&i| number[i as usize].to_le_bytes()));
    }
    bytes
}

fn header(vertices: usize, faces: usize) -> String {
    let floats: String = ["x", "y", "z", "nx", "ny", "nz"]
        .map(|name| format!("property float {name}\n"))
        .concat();
    let bytes: String = ["red", "green", "blue"]
        .map(|name| format!("property uchar {name}\n"))
        .concat();
    format!(
        "ply\nformat binary_little_endian 1.0\ncomment Relievo: x right, y up, z towards the viewer, units arbitrary\n\
         element vertex {vertices}\n{floats}{bytes}\
         element face {faces}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
}
