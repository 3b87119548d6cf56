//! What is joined to what (union–find).

/// Things numbered from 0, each in a group that bears the number of one of them.
pub struct Groups(Vec<usize>);

impl Groups {
    /// Each thing for itself.
    pub fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// The group of a thing.
    pub fn find(&mut self, mut k: usize) -> usize {
        while self.0[k] != k {
            self.0[k] = self.0[self.0[k]];
            k = self.0[k];
        }
        k
    }

    /// Group `from` becomes a part of group `into`.
    pub fn join(&mut self, into: usize, from: usize) {
        self.0[from] = into;
    }

    /// How many of `things` each group has.
    pub fn sizes(&mut self, things: &[Option<usize>]) -> Vec<usize> {
        let mut sizes = vec![0; self.0.len()];
        for &k in things.iter().flatten() {
            sizes[self.find(k)] += 1;
        }
        sizes
    }
}
