//! Things in the order of a number. Sorting is compiled once, for numbers and places, and not for everything that is
//! put into order: each sort takes seven kilobytes.

/// The things, those with the least number first; where it is equal, in the order that they had.
pub(crate) fn ordered<T>(things: Vec<T>, number: impl Fn(&T) -> f64) -> Vec<T> {
    let places = places(things.iter().map(number).collect());
    let mut things: Vec<Option<T>> = things.into_iter().map(Some).collect();
    places
        .into_iter()
        .filter_map(|at| things[at].take())
        .collect()
}

/// Where the numbers stand, the least first.
fn places(numbers: Vec<f64>) -> Vec<usize> {
    let mut numbered: Vec<(f64, usize)> = numbers.into_iter().zip(0..).collect();
    numbered.sort_unstable_by(|(a, i), (b, j)| a.total_cmp(b).then(i.cmp(j)));
    numbered.into_iter().map(|(_, at)| at).collect()
}

#[cfg(test)]
mod tests {
    use super::ordered;

    #[test]
    fn equal_numbers_keep_their_order() {
        let words = vec!["three", "one", "two", "seven", "a"];
        let by_length = ordered(words, |word| word.len() as f64);
        assert_eq!(by_length, ["a", "one", "two", "three", "seven"]);
    }
}
