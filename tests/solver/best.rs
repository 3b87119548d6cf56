//! measuring
use crate::support::*;
use relievo::scene;
#[test]
fn measure() {
    let mut all: Vec<_> = scene::names().map(|n| scene::render(n, 160, 120).unwrap()).collect();
    for (base, seed, noise, motion) in [("blocks", 11, 0.0, 2.0), ("blocks", 12, 2.0, 6.0), ("carousel", 13, 0.0, 3.0), ("carousel", 14, 1.0, 6.0), ("crowd", 15, 0.0, 4.0), ("blocks", 16, 3.0, 12.0)] {
        all.push(scene::variant(base, seed, noise, motion, 160, 120).unwrap());
    }
    for s in &all {
        let solver = solved(s);
        let sc = scores(&solver, s);
        let r = solver.report();
        println!("{} {:?} passes {} wrong {:.4} aee {:.4}\n  T {:?}\n  depth {:?}\n  flat {:?}\n  models {:?} amb {:?}\n  breaks {:?} hist {:?}\n  front {:?} expected {:?}", s.name, r.status, r.iterations, sc.labels_wrong, sc.aee.unwrap(), sc.translation_angle, sc.depth_error, sc.flat_depth_error, r.regions.iter().map(|r| r.model).collect::<Vec<_>>(), r.regions.iter().map(|r| r.ambiguous).collect::<Vec<_>>(), r.breaks, r.history, r.regions.iter().map(|r| r.in_front_of.clone()).collect::<Vec<_>>(), r.expected);
    }
}
