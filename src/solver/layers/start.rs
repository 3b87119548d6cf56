//! Where layers begin: motions that patches propose, and curves on the bodies that they are drawn on.
//!
//! A circle says which thing, hardly where it ends, and whatever else it holds would get a motion and a depth
//! of its own that compete with their owner's. So before the first pass the bodies that patches show are
//! looked for ([`Look::bodies`]), and once more if curves are more than bodies ([`Look::parted`]). If every
//! curve is on one of its own ([`start::assignment`]), motions are proposed from what is there, and curves go
//! there with their first step, to be held until regions know their depth (`schedule.rs`). Otherwise, and once
//! a pass has been made, curves start as drawn.

use super::Layers;
use crate::grid::Grid;
use crate::init::find_curves;
use crate::options::Options;
use crate::start::{self, Patch};

/// Rounds in which motions are proposed: in the first, curves do not know of each other's.
const PROPOSALS: usize = 3;

/// Where curves go before they are held: to the bodies that they are drawn on, if each is on one.
pub(super) enum Destination {
    /// Not looked for yet.
    Unknown,
    /// Level sets at the scale at work, where curves go with the next step of theirs.
    Ahead(Vec<Grid<f32>>),
    /// Curves are there, or not every curve is on one, or nobody shall look.
    Past,
}

impl Layers {
    /// Before the first pass: looks for the bodies that curves are drawn on, and for their motions there.
    pub(super) fn look_for_bodies(&mut self, options: &Options) {
        if !matches!(self.destination, Destination::Unknown) {
            return;
        }
        self.destination = Destination::Past;
        if !options.bodies || self.phi.is_empty() {
            return;
        }
        let theirs = self.bodies_of();
        if let Some(theirs) = theirs {
            let drawn = std::mem::replace(&mut self.phi, theirs);
            self.relabel();
            self.propose_motions(0);
            let bodies = std::mem::replace(&mut self.phi, drawn);
            self.relabel();
            self.destination = Destination::Ahead(bodies);
        }
    }

    /// The body that each curve is drawn on, if each is on one, as level sets.
    fn bodies_of(&self) -> Option<Vec<Grid<f32>>> {
        let whole = self.scales[0].whole();
        let shapes = find_curves(&self.pair, &self.scales[0].camera).into_iter();
        let all: Vec<Grid<f32>> = shapes
            .filter_map(|shape| shape.level_set(whole.width, whole.height, 0).ok())
            .map(|phi| self.at_this_scale(phi))
            .collect();
        let which = start::assignment(&self.phi, &all)?;
        Some(which.iter().map(|&b| all[b].clone()).collect())
    }

    /// Curves go to their bodies, and stay there until regions have motions and depth of their own.
    pub(super) fn go_to_bodies(&mut self) {
        if let Destination::Ahead(phi) = std::mem::replace(&mut self.destination, Destination::Past)
        {
            self.phi = phi;
            self.relabel();
            self.schedule.hold_curves();
        }
    }

    /// Motions for the regions from label `first` on: what most patches agree on, and inside each curve
    /// what that and the other curves' motions leave over.
    pub(super) fn propose_motions(&mut self, first: usize) {
        if first >= self.regions.len() {
            return;
        }
        let patches = start::patches(&self.scales, self.schedule.level);
        if patches.is_empty() {
            return;
        }
        let camera = self.here().camera;
        let within = |k: usize| -> Vec<f64> {
            let inside = |p: &Patch| self.labels[(p.x as usize, p.y as usize)] == k as u8;
            patches.iter().map(|p| f64::from(inside(p))).collect()
        };
        // Curves are drawn where a person saw something else move.
        let outside: Vec<f64> = within(0).iter().map(|w| 0.3 + 0.7 * w).collect();
        let background = start::dominant(&camera, &patches, &outside);
        let mut motions: Vec<_> = self.regions.iter().map(|r| r.motion).collect();
        if first == 0 {
            motions[0] = background;
        }
        for round in 0..PROPOSALS {
            for k in first.max(1)..motions.len() {
                let known = |j: usize| j != k && (round > 0 || j < first);
                let others = (1..motions.len()).filter(|&j| known(j));
                let others: Vec<_> = others.map(|j| motions[j]).collect();
                motions[k] = start::inside(&camera, &patches, &within(k), &background, &others);
            }
        }
        for (region, motion) in self.regions.iter_mut().zip(motions) {
            region.motion = motion;
        }
    }
}
