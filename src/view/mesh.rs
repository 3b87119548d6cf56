//! The depth map as a surface of triangles.
//!
//! Vertices lie on the rays of their pixels at the depth found, x to the right, y up, z towards the
//! viewer, in a box of about −1 to 1 in x or y (`foreshortening.rs`). The surface is cut along the borders of regions and
//! where depth leaps (`leaps.rs`), without skirts; the cut lies between pixels, where the two sides' smoothed shares are
//! equal, so that a circle ends on a circle. What goes on behind (`behind.rs`) is a surface of its own, darker. Regions of
//! unknown depth are kept apart, to be shown as ghosts or left out.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use super::ViewParams;
use super::foreshortening::boxed;
use super::layers::{Layer, Layers, NOTHING};
use super::leaps::{LABELS, neighbourhood, one_label_near};
use crate::frames::Frame;
use crate::interpretation::Interpretation;
use crate::window::places;

/// Vertices aimed at when the step is chosen automatically.
const VERTICES: usize = 90_000;
/// How far what is continued lies behind what is seen where both meet, as a share of 1/Z: it never shows through.
const BEHIND: f32 = 0.006;
/// Brightness left to what is continued.
const DIMMED: f32 = 0.55;
/// How far a cut may come to a vertex, as a share of the way between two: nearer, triangles are slivers.
const LEAST: f32 = 0.04;

/// A surface of triangles; flat lists as graphics cards want them.
///
/// ```
/// use relievo::scene;
/// use relievo::view::{self, ViewParams};
///
/// let flight = scene::render("flight", 64, 48)?;
/// let mesh = view::mesh(&flight.frames[0], &flight.truth, &ViewParams::default());
/// let vertices = mesh.positions.len() / 3;
/// assert_eq!(mesh.normals.len(), 3 * vertices);
/// assert!(mesh.indices.iter().all(|&i| (i as usize) < vertices));
/// assert_eq!(mesh.indices.len(), mesh.parts.iter().sum::<u32>() as usize);
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// x, y, z of each vertex.
    pub positions: Vec<f32>,
    /// Unit normal of each vertex, towards the viewer's side.
    pub normals: Vec<f32>,
    /// Place of each vertex in the frame, 0–1 from the lower left corner.
    pub uvs: Vec<f32>,
    /// sRGB of each vertex: of the frame where it is seen, greyed where depth is not known, guessed and darker where it
    /// is hidden.
    pub colours: Vec<u8>,
    /// Region of each vertex.
    pub labels: Vec<u8>,
    /// Whether depth was observable in the vertex's region (1) or is drawn flat (0).
    pub known: Vec<u8>,
    /// Three vertices for each triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// How many of `indices`, in this order, are of what is seen at a known depth, of what goes on hidden behind it, and of
    /// what is seen at an unknown depth.
    pub parts: [u32; 3],
    /// The factor that its depth is multiplied by.
    pub deepened: f32,
}

/// The surface of an interpretation, a vertex every [`ViewParams::step`] pixels, its depth multiplied
/// by [`ViewParams::relief`]. Each region is brought before the background as far as its outline says that it is, and
/// its depth is then multiplied by its factor of [`ViewParams::scales`].
pub fn mesh(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Mesh {
    let (width, height) = (frame.width(), frame.height());
    let automatic = ((width * height) as f32 / VERTICES as f32).sqrt().ceil() as usize;
    let step = params
        .step
        .unwrap_or(automatic)
        .clamp(1, width.min(height) - 1);
    // The last column and row are always there, so that the surface reaches the frame's border.
    let along = |side: usize| -> Vec<usize> {
        let mut places: Vec<usize> = (0..side).step_by(step).collect();
        if places.last() != Some(&(side - 1)) {
            places.push(side - 1);
        }
        places
    };
    let (columns, rows) = (along(width), along(height));
    let layers = Layers::of(frame, found, params, 1.0);
    let mut builder = Builder {
        frame,
        found,
        layers: &layers,
        mesh: Mesh::default(),
        triangles: Default::default(),
        cuts: BTreeMap::new(),
        sources: Vec::new(),
    };
    let corners = builder.see(&columns, &rows);
    for hidden in &layers.hidden {
        builder.continue_behind(hidden, &corners, columns.len());
    }
    builder.finish(params)
}

/// What a vertex shows.
#[derive(Clone, Copy)]
struct Point {
    label: u8,
    rho: f32,
    rgb: [u8; 3],
    known: bool,
}

/// A vertex of the grid.
#[derive(Clone, Copy)]
struct Corner {
    place: (usize, usize),
    vertex: u32,
    point: Point,
}

struct Builder<'a> {
    frame: &'a Frame,
    found: &'a Interpretation,
    layers: &'a Layers,
    mesh: Mesh,
    /// Of what is seen, of what is hidden, and of ghosts.
    triangles: [Vec<u32>; 3],
    /// The vertex on the line from one vertex to another, on the former's side of the cut.
    cuts: BTreeMap<(u32, u32), u32>,
    /// The vertex of the grid that each vertex on a cut belongs to.
    sources: Vec<(u32, u32)>,
}

impl Builder<'_> {
    /// A vertex at image place `at`, coloured as at `coloured`.
    fn vertex(&mut self, at: Vec2, coloured: Vec2, of: &Point) -> u32 {
        let &Point {
            label,
            rho,
            rgb,
            known,
        } = of;
        let z = rho.recip();
        let ray = self.found.camera.ray(at.x.into(), at.y.into()).as_vec3();
        let (w, h) = (self.frame.width() as f32, self.frame.height() as f32);
        let m = &mut self.mesh;
        m.positions.extend([ray.x * z, -ray.y * z, -z]);
        m.uvs
            .extend([(coloured.x + 0.5) / w, 1.0 - (coloured.y + 0.5) / h]);
        m.colours.extend(if known {
            rgb
        } else {
            super::mix(rgb, [110; 3], 0.5)
        });
        m.labels.push(label);
        m.known.push(u8::from(known));
        (m.labels.len() - 1) as u32
    }

    /// The surface that is seen.
    fn see(&mut self, columns: &[usize], rows: &[usize]) -> Vec<Corner> {
        let seen = &self.layers.seen;
        let one_label = one_label_near(&seen.labels);
        let mut corners = Vec::with_capacity(columns.len() * rows.len());
        for &y in rows {
            for &x in columns {
                let place = (x, y);
                let label = if one_label[place] {
                    seen.labels[place]
                } else {
                    self.smoothed(place)
                };
                let point = Point {
                    label,
                    rho: self.depth_of(label, place),
                    rgb: seen.colours[place],
                    known: seen.known[place],
                };
                let at = Vec2::new(x as f32, y as f32);
                let vertex = self.vertex(at, at, &point);
                corners.push(Corner {
                    place,
                    vertex,
                    point,
                });
            }
        }
        for cell in cells(columns.len(), rows.len()) {
            self.cell(cell.map(|i| corners[i]));
        }
        corners
    }

    /// The region that has most of a pixel's neighbourhood.
    fn smoothed(&self, place: (usize, usize)) -> u8 {
        let labels = &self.layers.seen.labels;
        let mut shares: Vec<(u8, f32)> = Vec::with_capacity(4);
        for (near, weight) in neighbourhood(&LABELS, labels.width(), labels.height(), place) {
            match shares.iter_mut().find(|(label, _)| *label == labels[near]) {
                Some((_, share)) => *share += weight,
                None => shares.push((labels[near], weight)),
            }
        }
        let most = shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        most.map_or(0, |(label, _)| label)
    }

    /// A region's share of a pixel's neighbourhood.
    fn share(&self, label: u8, place: (usize, usize)) -> f32 {
        let labels = &self.layers.seen.labels;
        let around = neighbourhood(&LABELS, labels.width(), labels.height(), place);
        around
            .filter(|(near, _)| labels[*near] == label)
            .map(|(_, weight)| weight)
            .sum()
    }

    /// A region's 1/Z at a pixel that may be another's.
    fn depth_of(&self, label: u8, place: (usize, usize)) -> f32 {
        let seen = &self.layers.seen;
        if seen.labels[place] == label {
            return seen.rho[place];
        }
        let (mut sum, mut weights) = (0.0, 0.0);
        for (near, weight) in neighbourhood(&LABELS, seen.rho.width(), seen.rho.height(), place) {
            if seen.labels[near] == label {
                sum += weight * seen.rho[near];
                weights += weight;
            }
        }
        sum / weights
    }

    /// The surface between four corners: one quadrangle, or what is left of each piece in it.
    fn cell(&mut self, corners: [Corner; 4]) {
        let pieces = self.pieces(&corners);
        for first in 0..4 {
            if pieces[..first].contains(&pieces[first]) {
                continue;
            }
            let mut outline = Vec::with_capacity(6);
            for i in 0..4 {
                let next = (i + 1) % 4;
                let (here, there) = (pieces[i] == pieces[first], pieces[next] == pieces[first]);
                if here {
                    outline.push(corners[i].vertex);
                }
                if here && !there {
                    outline.push(self.cut(corners[i], corners[next]));
                } else if there && !here {
                    outline.push(self.cut(corners[next], corners[i]));
                }
            }
            let known = corners[first].point.known;
            // A ghost that goes on is one sheet, which `continue_behind` draws: it must not show twice.
            let hidden = &self.layers.hidden[0];
            let continued = |c: &Corner| {
                hidden.labels[c.place] == corners[first].point.label && !hidden.known[c.place]
            };
            if !known && corners.iter().any(continued) {
                continue;
            }
            let list = &mut self.triangles[if known { 0 } else { 2 }];
            for i in 2..outline.len() {
                list.extend([outline[0], outline[i - 1], outline[i]]);
            }
        }
    }

    /// Corners of one piece have the same: of one region, on one side of a leap, and both known or not.
    fn pieces(&self, corners: &[Corner; 4]) -> [(u8, bool, bool); 4] {
        let points = corners.map(|corner| corner.point);
        points.map(|point| {
            let own = points.iter().filter(|p| p.label == point.label);
            let (low, high) = own.fold((f32::INFINITY, 0.0f32), |(low, high), p| {
                (low.min(p.rho), high.max(p.rho))
            });
            let near = self.layers.leap.between(low, high) && point.rho > (low + high) / 2.0;
            (point.label, near, point.known)
        })
    }

    /// The vertex of `own`'s piece on the line to `other`, which is of another.
    fn cut(&mut self, own: Corner, other: Corner) -> u32 {
        let key = (own.vertex, other.vertex);
        if let Some(&vertex) = self.cuts.get(&key) {
            return vertex;
        }
        let labels = [own.point.label, other.point.label];
        let (here, there) = if labels[0] == labels[1] {
            let psi = |c: Corner| self.layers.psi[c.place];
            (psi(own), -psi(other))
        } else {
            let lead = |at: Corner, against: Corner| {
                self.share(at.point.label, at.place) - self.share(against.point.label, at.place)
            };
            (lead(own, other), lead(other, own))
        };
        let way = here / (here + there);
        // Not a number, or beyond one of both, where the leap is spread further than it is looked for.
        let way = if way > 0.0 && way < 1.0 { way } else { 0.5 };
        let place = |c: Corner| Vec2::new(c.place.0 as f32, c.place.1 as f32);
        let at = place(own).lerp(place(other), way.clamp(LEAST, 1.0 - LEAST));
        // Short of the cut, where the frame's pixels mix both sides.
        let coloured = place(own).lerp(at, 0.5);
        let vertex = self.vertex(at, coloured, &own.point);
        self.sources.push((vertex, own.vertex));
        self.cuts.insert(key, vertex);
        vertex
    }

    /// The surface that goes on behind, from one vertex before it is hidden.
    fn continue_behind(&mut self, hidden: &Layer, corners: &[Corner], columns: usize) {
        let seen = &self.layers.seen;
        let leap = self.layers.leap;
        let dim = |rgb: [u8; 3]| rgb.map(|c| (f32::from(c) * DIMMED) as u8);
        let reached: Vec<Option<Point>> = corners
            .iter()
            .map(|&Corner { place, .. }| {
                (hidden.labels[place] != NOTHING).then(|| Point {
                    label: hidden.labels[place],
                    rho: hidden.rho[place],
                    rgb: dim(hidden.colours[place]),
                    known: hidden.known[place],
                })
            })
            .collect();
        let mut values = reached.clone();
        for cell in cells(columns, corners.len() / columns) {
            for (i, j) in cell.into_iter().flat_map(|i| cell.map(|j| (i, j))) {
                let (Some(from), None) = (reached[i], reached[j]) else {
                    continue;
                };
                // Of a smoothed outline a pixel may lie on either side.
                let Corner { place, point, .. } = corners[j];
                let own = Point {
                    label: seen.labels[place],
                    rho: seen.rho[place],
                    ..point
                };
                let one = |p: &Point| p.label == from.label && !leap.between(from.rho, p.rho);
                if let Some(point) = [own, point].into_iter().find(one) {
                    let back = if from.known { BEHIND } else { 0.0 };
                    values[j] = Some(Point {
                        rho: point.rho / (1.0 + back),
                        rgb: dim(point.rgb),
                        known: from.known,
                        ..point
                    });
                }
            }
        }
        let placed = values.iter().enumerate().map(|(i, value)| {
            let (x, y) = corners[i].place;
            let place = Vec2::new(x as f32, y as f32);
            value.map(|point| (self.vertex(place, place, &point), point))
        });
        let vertices: Vec<Option<(u32, Point)>> = placed.collect();
        for cell in cells(columns, corners.len() / columns) {
            let outline: Vec<(u32, Point)> = cell.iter().filter_map(|&i| vertices[i]).collect();
            let next = outline.iter().cycle().skip(1);
            let mut pairs = outline.iter().zip(next);
            let whole =
                pairs.all(|((_, a), (_, b))| a.label == b.label && !leap.between(a.rho, b.rho));
            if outline.len() < 3 || !whole {
                continue;
            }
            let known = outline.iter().all(|(_, point)| point.known);
            let list = &mut self.triangles[if known { 1 } else { 2 }];
            for i in 2..outline.len() {
                list.extend([outline[0], outline[i - 1], outline[i]].map(|(vertex, _)| vertex));
            }
        }
    }

    fn finish(mut self, params: &ViewParams) -> Mesh {
        let m = &mut self.mesh;
        m.parts = [0, 1, 2].map(|i| self.triangles[i].len() as u32);
        m.indices = self.triangles.concat();
        let mut points: Vec<Vec3> = m.positions.chunks_exact(3).map(Vec3::from_slice).collect();
        let side = self.frame.width().max(self.frame.height()) as f32;
        let deepen = params.relief.map(|r| r as f32);
        let focal = self.found.camera.focal as f32;
        m.deepened = boxed(&mut points, self.layers.range, side / focal, deepen);
        let mut normals = vec![Vec3::ZERO; points.len()];
        for t in m.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| i as usize);
            // Twice the area long, so that large triangles count for more.
            let normal = (points[b] - points[a]).cross(points[c] - points[a]);
            for i in [a, b, c] {
                normals[i] += normal;
            }
        }
        // A cut's own triangles are small and lean where they will: the surface beside it tells better.
        for &(vertex, source) in &self.sources {
            let known = normals[source as usize];
            if known != Vec3::ZERO {
                normals[vertex as usize] = known;
            }
        }
        m.positions = points.iter().flat_map(|p| p.to_array()).collect();
        m.normals = normals
            .iter()
            .flat_map(|n| n.try_normalize().unwrap_or(Vec3::Z).to_array())
            .collect();
        self.mesh
    }
}

/// The corners of every cell of a grid of vertices, counter-clockwise as seen: down the left side, up the right one.
fn cells(columns: usize, rows: usize) -> impl Iterator<Item = [usize; 4]> {
    places(1..columns, 1..rows).map(move |(x, y)| {
        let (above, below) = ((y - 1) * columns + x, y * columns + x);
        [above - 1, below - 1, below, above]
    })
}
