//! The depth map as a surface of triangles.
//!
//! Vertices lie on the rays of their pixels at the depth found, x to the right, y up, z towards the
//! viewer, in a box of about −1 to 1 in x or y (`foreshortening.rs`). The surface is cut along the borders
//! of regions, half-way between pixels, without skirts, and where depth leaps (`tears.rs`). A region whose depth is
//! nowhere observable is flat, and if it is the background, behind all others.

use glam::{Vec2, Vec3};

use super::ViewParams;
use super::foreshortening::boxed;
use super::span::{OBSERVABLE, Span};
use super::tears::{Corner, leaps, torn};
use crate::frames::Frame;
use crate::interpretation::Interpretation;

/// Vertices aimed at when the step is chosen automatically.
const VERTICES: usize = 90_000;
/// Share of a region's pixels that must have observable depth for it to have a relief.
const LEAST_KNOWN: f32 = 0.02;

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
    /// sRGB of each vertex, greyed where depth is not known.
    pub colours: Vec<u8>,
    /// Region of each vertex.
    pub labels: Vec<u8>,
    /// Whether depth was observable in the vertex's region (1) or is drawn flat (0).
    pub known: Vec<u8>,
    /// Three vertices for each triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
}

/// The surface of an interpretation, a vertex every [`ViewParams::step`] pixels, its depth multiplied
/// by [`ViewParams::relief`].
pub fn mesh(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Mesh {
    let (width, height) = (frame.width(), frame.height());
    let automatic = ((width * height) as f32 / VERTICES as f32).sqrt().ceil() as usize;
    let step = params
        .step
        .unwrap_or(automatic)
        .clamp(1, width.min(height) - 1);
    let regions: Vec<Shown> = (0..=u8::MAX)
        .take(found.regions().max(1))
        .map(|k| Shown::of(found, k))
        .collect();
    let regions = Shown::background_behind(regions);
    let mut builder = Builder {
        frame,
        found,
        regions,
        mesh: Mesh::default(),
    };
    // The last column and row are always there, so that the surface reaches the frame's border.
    let along = |side: usize| -> Vec<usize> {
        let mut places: Vec<usize> = (0..side).step_by(step).collect();
        if places.last() != Some(&(side - 1)) {
            places.push(side - 1);
        }
        places
    };
    let (columns, rows) = (along(width), along(height));
    let corner: Vec<u32> = rows
        .iter()
        .flat_map(|&y| columns.iter().map(move |&x| (x, y)))
        .map(|(x, y)| builder.vertex((x, y), Vec2::new(x as f32, y as f32)))
        .collect();
    for (j, y) in rows.windows(2).enumerate() {
        for (i, x) in columns.windows(2).enumerate() {
            let at = j * columns.len() + i;
            let below = at + columns.len();
            // Counter-clockwise as seen: down the left side, up the right one.
            let places = [(x[0], y[0]), (x[0], y[1]), (x[1], y[1]), (x[1], y[0])];
            let vertices = [corner[at], corner[below], corner[below + 1], corner[at + 1]];
            builder.cell(places, vertices);
        }
    }
    builder.finish(params, [columns.len(), rows.len()])
}

/// How a region is drawn.
struct Shown {
    known: bool,
    span: Span,
}

impl Shown {
    fn of(found: &Interpretation, label: u8) -> Self {
        let inside = |i: usize| found.labels.data()[i] == label;
        let pixels = (0..found.labels.len()).filter(|&i| inside(i)).count();
        let known = (0..found.labels.len())
            .filter(|&i| inside(i) && found.confidence.data()[i] >= OBSERVABLE)
            .count();
        let span = Span::of(found, true, inside).unwrap_or(Span {
            far: 1.0,
            near: 1.0,
        });
        Self {
            known: known as f32 >= LEAST_KNOWN * pixels as f32 && known > 0,
            span,
        }
    }

    /// A background of unknown depth is put as far as the farthest that is known: it is hidden by all.
    fn background_behind(mut regions: Vec<Self>) -> Vec<Self> {
        let known = regions.iter().filter(|r| r.known).map(|r| r.span.far);
        let farthest = known.fold(f32::INFINITY, f32::min);
        let background = &mut regions[0];
        if !background.known && farthest.is_finite() {
            background.span = Span {
                far: farthest,
                near: farthest,
            };
        }
        regions
    }

    /// Depth as drawn: within the span and a little beyond; the middle of it where nothing is known.
    fn depth(&self, depth: f32) -> f32 {
        let middle = (self.span.near + self.span.far) / 2.0;
        let beyond = 0.3 * (self.span.near - self.span.far);
        let rho = 1.0 / depth;
        if !self.known || !rho.is_finite() {
            return 1.0 / middle;
        }
        1.0 / rho.clamp(
            (self.span.far - beyond).max(0.2 * self.span.far),
            self.span.near + beyond,
        )
    }
}

struct Builder<'a> {
    frame: &'a Frame,
    found: &'a Interpretation,
    regions: Vec<Shown>,
    mesh: Mesh,
}

impl Builder<'_> {
    /// A vertex at image place `at` with the depth, colour and region of pixel `of`.
    fn vertex(&mut self, of: (usize, usize), at: Vec2) -> u32 {
        let label = self.found.labels[of];
        let region = &self.regions[usize::from(label).min(self.regions.len() - 1)];
        let z = region.depth(self.found.depth[of]);
        let ray = self.found.camera.ray(at.x.into(), at.y.into()).as_vec3();
        let m = &mut self.mesh;
        m.positions.extend([ray.x * z, -ray.y * z, -z]);
        let (w, h) = (self.frame.width() as f32, self.frame.height() as f32);
        m.uvs.extend([(at.x + 0.5) / w, 1.0 - (at.y + 0.5) / h]);
        let rgb = self.frame.rgb[of];
        m.colours.extend(if region.known {
            rgb
        } else {
            super::mix(rgb, [110; 3], 0.5)
        });
        m.labels.push(label);
        m.known.push(u8::from(region.known));
        (m.labels.len() - 1) as u32
    }

    /// The surface between four corners: one quadrangle, or the share of each region in it, cut
    /// half-way along each side that leaves it.
    fn cell(&mut self, places: [(usize, usize); 4], vertices: [u32; 4]) {
        let labels = places.map(|p| self.found.labels[p]);
        for (first, &label) in labels.iter().enumerate() {
            if labels[..first].contains(&label) {
                continue;
            }
            let mut outline = Vec::with_capacity(6);
            for i in 0..4 {
                let next = (i + 1) % 4;
                let (here, there) = (labels[i] == label, labels[next] == label);
                if here {
                    outline.push(vertices[i]);
                }
                if here != there {
                    let of = if here { places[i] } else { places[next] };
                    let middle = |a: usize, b: usize| (a + b) as f32 / 2.0;
                    let at = Vec2::new(
                        middle(places[i].0, places[next].0),
                        middle(places[i].1, places[next].1),
                    );
                    outline.push(self.vertex(of, at));
                }
            }
            for i in 2..outline.len() {
                self.mesh
                    .indices
                    .extend([outline[0], outline[i - 1], outline[i]]);
            }
        }
    }

    fn finish(mut self, params: &ViewParams, corners: [usize; 2]) -> Mesh {
        let m = &mut self.mesh;
        let mut points: Vec<Vec3> = m.positions.chunks_exact(3).map(Vec3::from_slice).collect();
        let depth: Vec<f32> = points.iter().map(|p| -p.z).collect();
        let leaps = leaps(&depth, &m.labels, corners);
        let (width, height) = (self.frame.width() as f32, self.frame.height() as f32);
        let side = width.max(height);
        let deepen = params.relief.map(|r| r as f32);
        boxed(&mut points, side / self.found.camera.focal as f32, deepen);
        let corner = |i: u32| {
            let i = i as usize;
            Corner {
                place: 2.0 / side * Vec2::new(width * m.uvs[2 * i], height * m.uvs[2 * i + 1]),
                depth: points[i].z,
                leaps: leaps.get(i).copied().unwrap_or(false),
            }
        };
        let whole = |t: &&[u32]| !torn([t[0], t[1], t[2]].map(corner));
        let kept = m.indices.chunks_exact(3).filter(whole);
        m.indices = kept.flatten().copied().collect();
        let mut normals = vec![Vec3::ZERO; points.len()];
        for t in m.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| i as usize);
            // Twice the area long, so that large triangles count for more.
            let normal = (points[b] - points[a]).cross(points[c] - points[a]);
            for i in [a, b, c] {
                normals[i] += normal;
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
