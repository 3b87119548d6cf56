//! Numbers and grids as few bytes, little-endian, and back: what a solver's state is made of.
//!
//! A whole number is written seven bits at a time, the lowest first. Labels are written as runs. Floats of a grid are
//! kept to the bit: each is replaced by its difference from the one before, and of these come all lowest bytes first, then
//! the next, so that whoever compresses the whole finds zeros. Whole numbers of a grid are differences likewise.

use super::unreadable;
use crate::error::Error;

/// Writes.
#[derive(Default)]
pub(crate) struct Packer(pub Vec<u8>);

impl Packer {
    pub fn byte(&mut self, byte: u8) {
        self.0.push(byte);
    }

    pub fn flag(&mut self, flag: bool) {
        self.byte(u8::from(flag));
    }

    pub fn whole(&mut self, mut number: usize) {
        while number >= 128 {
            self.0.push(number as u8 | 128);
            number >>= 7;
        }
        self.0.push(number as u8);
    }

    pub fn float(&mut self, number: f64) {
        self.0.extend(number.to_le_bytes());
    }

    pub fn floats(&mut self, numbers: impl IntoIterator<Item = f64>) {
        numbers.into_iter().for_each(|number| self.float(number));
    }

    pub fn single(&mut self, number: f32) {
        self.0.extend(number.to_le_bytes());
    }

    /// Which of `all` it is.
    pub fn one_of<T: PartialEq>(&mut self, all: &[T], which: &T) {
        self.whole(all.iter().position(|one| one == which).unwrap_or(0));
    }

    /// As many as there are, one after the other.
    pub fn list<T>(&mut self, things: &[T], write: impl Fn(&mut Self, &T)) {
        self.whole(things.len());
        things.iter().for_each(|thing| write(self, thing));
    }

    /// One byte a pixel, as runs.
    pub fn labels(&mut self, labels: &[u8]) {
        for run in labels.chunk_by(|a, b| a == b) {
            self.byte(run[0]);
            self.whole(run.len());
        }
    }

    /// Every bit of each.
    pub fn exact(&mut self, values: &[f32]) {
        planes(
            values.iter().map(|value| value.to_bits().cast_signed()),
            &mut self.0,
        );
    }

    /// Whole numbers of which neighbours are alike.
    pub fn alike(&mut self, values: impl Iterator<Item = i32>) {
        let mut last = 0i32;
        for value in values {
            self.whole(zigzag(value.wrapping_sub(last)) as usize);
            last = value;
        }
    }
}

/// Reads what a [`Packer`] wrote, in the same order.
pub(crate) struct Unpacker<'a> {
    rest: &'a [u8],
    name: &'a str,
    format: &'static str,
}

impl<'a> Unpacker<'a> {
    /// `name` and `format` are what errors say.
    pub fn new(bytes: &'a [u8], name: &'a str, format: &'static str) -> Self {
        Self {
            rest: bytes,
            name,
            format,
        }
    }

    /// What is wrong with the bytes.
    pub fn wrong(&self, reason: &str) -> Error {
        unreadable(self.name, self.format, reason)
    }

    pub fn take(&mut self, count: usize) -> Result<&'a [u8], Error> {
        match self.rest.split_at_checked(count) {
            Some((taken, rest)) => {
                self.rest = rest;
                Ok(taken)
            }
            None => Err(self.wrong("it ends too early")),
        }
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    pub fn byte(&mut self) -> Result<u8, Error> {
        Ok(self.take(1)?[0])
    }

    pub fn flag(&mut self) -> Result<bool, Error> {
        match self.byte()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(self.wrong("a yes or no in it is neither")),
        }
    }

    /// A whole number of at most `most`.
    pub fn whole(&mut self, most: usize) -> Result<usize, Error> {
        let mut number = 0u64;
        for place in 0..5 {
            let byte = self.byte()?;
            number |= u64::from(byte & 127) << (7 * place);
            if byte < 128 {
                return match usize::try_from(number) {
                    Ok(number) if number <= most => Ok(number),
                    _ => Err(self.wrong("a number in it is too large")),
                };
            }
        }
        Err(self.wrong("a number in it is too large"))
    }

    pub fn float(&mut self) -> Result<f64, Error> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    /// Numbers that are finite.
    pub fn floats<const N: usize>(&mut self) -> Result<[f64; N], Error> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.float()?;
        }
        self.numbers(numbers.iter().all(|number| number.is_finite()))?;
        Ok(numbers)
    }

    /// A number that is finite.
    pub fn single(&mut self) -> Result<f32, Error> {
        let number = f32::from_le_bytes(self.array()?);
        self.numbers(number.is_finite())?;
        Ok(number)
    }

    fn numbers(&self, are: bool) -> Result<(), Error> {
        if are {
            Ok(())
        } else {
            Err(self.wrong("a number in it is none"))
        }
    }

    /// One of `all`.
    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> Result<T, Error> {
        Ok(all[self.whole(all.len() - 1)?])
    }

    /// At most so many things.
    pub fn list<T>(
        &mut self,
        most: usize,
        read: impl Fn(&mut Self) -> Result<T, Error>,
    ) -> Result<Vec<T>, Error> {
        let count = self.whole(most)?;
        self.times(count, read)
    }

    /// So many things.
    pub fn times<T>(
        &mut self,
        count: usize,
        read: impl Fn(&mut Self) -> Result<T, Error>,
    ) -> Result<Vec<T>, Error> {
        (0..count).map(|_| read(self)).collect()
    }

    /// So many labels, each of which is `known`.
    pub fn labels(&mut self, count: usize, known: impl Fn(u8) -> bool) -> Result<Vec<u8>, Error> {
        let mut labels = Vec::new();
        while labels.len() < count {
            let label = self.byte()?;
            let length = self.whole(count - labels.len())?;
            if length == 0 || !known(label) {
                return Err(self.wrong("it has a label without a region"));
            }
            labels.resize(labels.len() + length, label);
        }
        Ok(labels)
    }

    /// So many floats that were written with every bit, all finite.
    pub fn exact(&mut self, count: usize) -> Result<Vec<f32>, Error> {
        let bytes = self.take(count.saturating_mul(4))?;
        let values: Vec<f32> = from_planes(bytes)
            .map(|bits| f32::from_bits(bits.cast_unsigned()))
            .collect();
        self.numbers(values.iter().all(|value| value.is_finite()))?;
        Ok(values)
    }

    /// So many whole numbers that were written as [`Packer::alike`].
    pub fn alike(&mut self, count: usize) -> Result<Vec<i32>, Error> {
        // A number takes a byte at least.
        if count > self.rest.len() {
            return Err(self.wrong("it ends too early"));
        }
        let mut last = 0i32;
        let next = |_| {
            let difference = self.whole(u32::MAX as usize)?;
            last = last.wrapping_add(unzigzag(difference as u32));
            Ok(last)
        };
        (0..count).map(next).collect()
    }

    /// Nothing may follow.
    pub fn end(&self) -> Result<(), Error> {
        if self.rest.is_empty() {
            Ok(())
        } else {
            Err(self.wrong("it goes on after its end"))
        }
    }
}

/// Appends the differences of whole numbers, byte by byte.
pub(super) fn planes(values: impl Iterator<Item = i32>, bytes: &mut Vec<u8>) {
    let mut last = 0i32;
    let differences: Vec<[u8; 4]> = values
        .map(|value| {
            let difference = value.wrapping_sub(last);
            last = value;
            zigzag(difference).to_le_bytes()
        })
        .collect();
    for byte in 0..4 {
        bytes.extend(differences.iter().map(|difference| difference[byte]));
    }
}

/// The numbers whose differences these bytes are.
pub(super) fn from_planes(bytes: &[u8]) -> impl Iterator<Item = i32> {
    let count = bytes.len() / 4;
    let mut last = 0i32;
    (0..count).map(move |i| {
        let four = [0, 1, 2, 3].map(|byte| bytes[byte * count + i]);
        last = last.wrapping_add(unzigzag(u32::from_le_bytes(four)));
        last
    })
}

/// Small numbers of either sign as small numbers: 0, −1, 1, −2, … as 0, 1, 2, 3, …
fn zigzag(n: i32) -> u32 {
    ((n << 1) ^ (n >> 31)).cast_unsigned()
}

fn unzigzag(n: u32) -> i32 {
    (n >> 1).cast_signed() ^ -((n & 1).cast_signed())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LABELS: [u8; 7] = [0, 0, 0, 2, 2, 1, 0];
    const VALUES: [f32; 5] = [1.0, -0.25, 1e-30, 3.5e7, -0.0];
    const WHOLES: [i32; 5] = [3, 3, -90_000, i32::MAX, i32::MIN];

    fn packed() -> Vec<u8> {
        let mut to = Packer::default();
        to.flag(true);
        to.whole(300);
        to.float(0.1);
        to.single(0.2);
        to.labels(&LABELS);
        to.exact(&VALUES);
        to.alike(WHOLES.into_iter());
        to.0
    }

    fn unpack(bytes: &[u8]) -> Result<(), Error> {
        let mut from = Unpacker::new(bytes, "it", "packed");
        assert!(from.flag()?);
        assert_eq!(from.whole(300)?, 300);
        assert_eq!(from.float()?, 0.1);
        assert_eq!(from.single()?, 0.2);
        assert_eq!(from.labels(7, |k| k < 3)?, LABELS);
        let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&from.exact(5)?), bits(&VALUES));
        assert_eq!(from.alike(5)?, WHOLES);
        from.end()
    }

    #[test]
    fn all_comes_back_as_it_was() {
        unpack(&packed()).unwrap();
    }

    #[test]
    fn what_is_cut_or_goes_on_is_refused() {
        let mut whole = packed();
        for end in 0..whole.len() {
            assert!(unpack(&whole[..end]).is_err(), "{end}");
        }
        whole.push(0);
        assert!(unpack(&whole).is_err());
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let reader = |bytes| Unpacker::new(bytes, "it", "packed");
        assert!(reader(&[2]).flag().is_err());
        assert!(reader(&[200, 3]).whole(300).is_err());
        assert!(reader(&[255; 9]).whole(usize::MAX).is_err());
        // A run of nothing, one that is too long, and a label that nobody has.
        assert!(reader(&[0, 0]).labels(4, |_| true).is_err());
        assert!(reader(&[0, 5]).labels(4, |_| true).is_err());
        assert!(reader(&[3, 4]).labels(4, |k| k < 3).is_err());
        let mut nan = Packer::default();
        nan.exact(&[f32::NAN]);
        assert!(reader(&nan.0).exact(1).is_err());
        assert!(reader(&[]).exact(usize::MAX).is_err());
        assert!(reader(&[]).alike(usize::MAX).is_err());
    }
}
