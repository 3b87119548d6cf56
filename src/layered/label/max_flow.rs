//! The cheapest cut of a graph of pixels in two, by the largest flow through it (Ford and Fulkerson 1956; Dinic 1970).
//!
//! ```text
//! min over A, B   Σ_{i∈B} max(ti, 0)  +  Σ_{i∈A} max(−ti, 0)  +  Σ_{i∈A, j∈B} c_ij
//! ```
//!
//! ti > 0 is what it costs to have node i on side B instead of A, c_ij ≥ 0 what to part it from a neighbour, of which it has
//! eight at most. Each phase finds the nodes' distances from A and fills the shortest ways to B; these get longer from
//! phase to phase. It stops when no way is left: what A still reaches is its side.

/// Steps to the eight neighbours; each two are opposite.
pub(super) const STEPS: [(isize, isize); 8] = [
    (1, 0),
    (-1, 0),
    (0, 1),
    (0, -1),
    (1, 1),
    (-1, -1),
    (-1, 1),
    (1, -1),
];
/// Capacities below this are none: rounding leaves as much.
const NOTHING: f32 = 1e-5;
/// Farther than any node, and the number of none.
pub(super) const NOWHERE: u32 = u32::MAX;

/// One node.
#[derive(Clone, Copy, Default)]
pub(super) struct Node {
    /// ti, in a unit in which costs are about 1.
    pub terminal: f32,
    /// c to each neighbour; 0 where there is none.
    pub capacities: [f32; 8],
    /// The neighbours' numbers.
    pub neighbours: [u32; 8],
}

/// The graph, and memory to cut it.
#[derive(Default)]
pub(super) struct Graph {
    /// All nodes.
    pub nodes: Vec<Node>,
    distance: Vec<u32>,
    queue: Vec<u32>,
    /// The first neighbour of each node that has not been found a dead end.
    next: Vec<u8>,
    way: Vec<(u32, u8)>,
}

impl Graph {
    /// Cuts it; `is_a` then tells sides.
    pub fn cut(&mut self) {
        while let Some(sources) = self.measure() {
            self.next.clear();
            self.next.resize(self.nodes.len(), 0);
            for source in 0..sources {
                let source = self.queue[source] as usize;
                while self.nodes[source].terminal > NOTHING && self.find_way(source) {
                    self.fill_way(source);
                }
            }
        }
    }

    /// Whether node i is on A's side of the cut.
    pub fn is_a(&self, i: usize) -> bool {
        self.distance[i] != NOWHERE
    }

    /// Distances from A, as far as to the nearest node that is drawn to B; the number of nodes drawn to A, which head
    /// the queue, or `None` when no way is left.
    fn measure(&mut self) -> Option<usize> {
        self.distance.clear();
        self.distance.resize(self.nodes.len(), NOWHERE);
        self.queue.clear();
        for (i, node) in self.nodes.iter().enumerate() {
            if node.terminal > NOTHING {
                self.distance[i] = 0;
                self.queue.push(i as u32);
            }
        }
        let sources = self.queue.len();
        let (mut at, mut nearest) = (0, NOWHERE);
        while let Some(&i) = self.queue.get(at) {
            at += 1;
            let (node, distance) = (&self.nodes[i as usize], self.distance[i as usize]);
            if distance >= nearest {
                break;
            }
            if node.terminal < -NOTHING {
                nearest = distance;
                continue;
            }
            for (&capacity, &j) in node.capacities.iter().zip(&node.neighbours) {
                if capacity > NOTHING && self.distance[j as usize] == NOWHERE {
                    self.distance[j as usize] = distance + 1;
                    self.queue.push(j);
                }
            }
        }
        (nearest != NOWHERE).then_some(sources)
    }

    /// Looks for a shortest way from a node to one that is drawn to B.
    fn find_way(&mut self, source: usize) -> bool {
        self.way.clear();
        let mut i = source;
        while self.nodes[i].terminal >= -NOTHING {
            let (node, farther) = (&self.nodes[i], self.distance[i] + 1);
            let mut step = usize::from(self.next[i]);
            while step < 8
                && !(node.capacities[step] > NOTHING
                    && self.distance[node.neighbours[step] as usize] == farther)
            {
                step += 1;
            }
            self.next[i] = step as u8;
            if step < 8 {
                self.way.push((i as u32, step as u8));
                i = node.neighbours[step] as usize;
            } else if let Some((back, _)) = self.way.pop() {
                i = back as usize;
                self.next[i] += 1;
            } else {
                return false;
            }
        }
        self.way.push((i as u32, 0));
        true
    }

    /// Sends along the way found as much as passes.
    fn fill_way(&mut self, source: usize) {
        let Some((end, _)) = self.way.pop() else {
            return;
        };
        let end = end as usize;
        let passes = |&(i, step): &(u32, u8)| self.nodes[i as usize].capacities[usize::from(step)];
        let ends = self.nodes[source].terminal.min(-self.nodes[end].terminal);
        let flow = self.way.iter().map(passes).fold(ends, f32::min);
        for &(i, step) in &self.way {
            let (node, step) = (&mut self.nodes[i as usize], usize::from(step));
            node.capacities[step] -= flow;
            let j = node.neighbours[step] as usize;
            self.nodes[j].capacities[step ^ 1] += flow;
        }
        self.nodes[source].terminal -= flow;
        self.nodes[end].terminal += flow;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes in a row, each tied to the next by a capacity of one.
    fn row(terminals: &[f32]) -> Graph {
        let mut graph = Graph::default();
        for (i, &terminal) in terminals.iter().enumerate() {
            let mut node = Node {
                terminal,
                ..Node::default()
            };
            if i + 1 < terminals.len() {
                (node.capacities[0], node.neighbours[0]) = (1.0, i as u32 + 1);
            }
            if i > 0 {
                (node.capacities[1], node.neighbours[1]) = (1.0, i as u32 - 1);
            }
            graph.nodes.push(node);
        }
        graph
    }

    fn sides(terminals: &[f32]) -> Vec<bool> {
        let mut graph = row(terminals);
        graph.cut();
        (0..terminals.len()).map(|i| graph.is_a(i)).collect()
    }

    #[test]
    fn a_row_is_cut_where_that_is_cheapest() {
        assert_eq!(sides(&[3.0, 0.2, -0.4, -3.0]), [true, true, false, false]);
        // One that disagrees by less than two ties goes with the others, by more it does not.
        assert_eq!(sides(&[3.0, 3.0, -1.5, 3.0]), [true; 4]);
        assert_eq!(sides(&[3.0, 3.0, -2.5, 3.0]), [true, true, false, true]);
    }

    #[test]
    fn without_a_wish_for_either_side_nothing_is_cut() {
        assert_eq!(sides(&[1.0, 0.0, 0.0]), [true; 3]);
        assert_eq!(sides(&[-1.0, 0.0, 0.0]), [false; 3]);
        assert_eq!(sides(&[]), Vec::<bool>::new());
    }

    #[test]
    fn flow_is_turned_aside_where_another_needs_its_place() {
        // 0 sends to 3 by 1 and 2 at first, then by 4 and 5 to 6, for 7 comes to 3 by 8, 9 and 2 only.
        let mut graph = Graph {
            nodes: vec![Node::default(); 10],
            ..Graph::default()
        };
        for (i, terminal) in [(0, 1.0), (7, 1.0), (3, -1.0), (6, -1.0)] {
            graph.nodes[i].terminal = terminal;
        }
        for (from, to, step) in [
            (0, 1, 0),
            (1, 2, 2),
            (2, 3, 0),
            (1, 4, 4),
            (4, 5, 0),
            (5, 6, 2),
            (7, 8, 0),
            (8, 9, 2),
            (9, 2, 4),
        ] {
            graph.nodes[from].capacities[step] = 1.0;
            graph.nodes[from].neighbours[step] = to as u32;
            graph.nodes[to].neighbours[step ^ 1] = from as u32;
        }
        graph.cut();
        assert!(!(0..10).any(|i| graph.is_a(i)));
    }
}
