//! Connected parts: what hangs together by way of neighbours.

/// The parts that the things 0 to `count` − 1 fall into, in the order of their first ones, without those that are not
/// `wanted`. `neighbours` are what a thing is joined to.
pub(crate) fn parts<N: IntoIterator<Item = usize>>(
    count: usize,
    wanted: impl Fn(usize) -> bool,
    neighbours: impl Fn(usize) -> N,
) -> Vec<Vec<usize>> {
    let mut open: Vec<bool> = (0..count).map(wanted).collect();
    let mut parts = Vec::new();
    for first in 0..count {
        if !std::mem::take(&mut open[first]) {
            continue;
        }
        let mut part = vec![first];
        let mut next = 0;
        while let Some(&k) = part.get(next) {
            next += 1;
            part.extend((neighbours(k).into_iter()).filter(|&o| std::mem::take(&mut open[o])));
        }
        parts.push(part);
    }
    parts
}
