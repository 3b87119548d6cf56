//! The numbers in a photo's EXIF block, which is a TIFF file: a directory of the picture, and behind one of its entries
//! another of the exposure.
//!
//! The first four bytes tell the order of bytes, the next four where the picture's directory is. A directory is the
//! number of its entries, then entries of twelve bytes: tag, type, count, and the value or, if that takes more than four
//! bytes, where it is. Nothing is sought twice, so that no block can keep a reader busy.

/// The entry that says where the directory of the exposure is.
const EXPOSURE: u16 = 0x8769;

/// Bytes of an entry.
const ENTRY: usize = 12;

/// A block.
#[derive(Clone, Copy)]
pub(super) struct Exif<'a> {
    bytes: &'a [u8],
    /// Whether the lowest byte comes first.
    little: bool,
}

impl<'a> Exif<'a> {
    /// `None` unless it begins as a TIFF file of 32 bits does.
    pub fn new(bytes: &'a [u8]) -> Option<Self> {
        let little = match bytes.first_chunk()? {
            b"II*\0" => true,
            b"MM\0*" => false,
            _ => return None,
        };
        Some(Self { bytes, little })
    }

    /// A number of the picture: the first of those that `tag` has; `None` where it has none.
    pub fn of_picture(self, tag: u16) -> Option<f64> {
        self.number(self.long(4)?, tag)
    }

    /// A number of the exposure.
    pub fn of_exposure(self, tag: u16) -> Option<f64> {
        let entry = self.entry(self.long(4)?, EXPOSURE)?;
        self.number(self.long(entry + 8)?, tag)
    }

    fn number(self, directory: usize, tag: u16) -> Option<f64> {
        let entry = self.entry(directory, tag)?;
        let kind = self.short(entry + 2)?;
        let size = match kind {
            1 => 1,
            3 => 2,
            4 => 4,
            5 => 8,
            _ => return None,
        };
        let place = match self.long(entry + 4)? {
            0 => return None,
            count if count <= 4 / size => entry + 8,
            _ => self.long(entry + 8)?,
        };
        let whole = |at| self.long(at).map(|n| n as f64);
        match kind {
            1 => self.bytes.get(place).copied().map(f64::from),
            3 => self.short(place).map(f64::from),
            4 => whole(place),
            _ => Some(whole(place)? / whole(place.checked_add(4)?)?),
        }
    }

    /// Where the entry of `tag` is.
    fn entry(self, directory: usize, tag: u16) -> Option<usize> {
        let count = usize::from(self.short(directory)?);
        let entries = self.bytes.get(directory + 2..)?.chunks_exact(ENTRY);
        let at = (0..count.min(entries.len())).map(|k| directory + 2 + k * ENTRY);
        at.into_iter().find(|&at| self.short(at) == Some(tag))
    }

    fn short(self, at: usize) -> Option<u16> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        Some(match self.little {
            true => u16::from_le_bytes(bytes),
            false => u16::from_be_bytes(bytes),
        })
    }

    fn long(self, at: usize) -> Option<usize> {
        let bytes = *self.bytes.get(at..)?.first_chunk()?;
        Some(match self.little {
            true => u32::from_le_bytes(bytes),
            false => u32::from_be_bytes(bytes),
        } as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::Exif;

    /// A block of one directory, its entries (tag, type, count, value) in the order of bytes that is asked for.
    fn block(little: bool, entries: &[(u16, u16, u32, [u8; 4])], behind: &[u32]) -> Vec<u8> {
        let short = |n: u16| {
            if little {
                n.to_le_bytes()
            } else {
                n.to_be_bytes()
            }
        };
        let long = |n: u32| {
            if little {
                n.to_le_bytes()
            } else {
                n.to_be_bytes()
            }
        };
        let mut block = if little { *b"II*\0" } else { *b"MM\0*" }.to_vec();
        block.extend(long(8));
        block.extend(short(entries.len() as u16));
        for &(tag, kind, count, value) in entries {
            block.extend([short(tag), short(kind)].concat());
            block.extend(long(count));
            block.extend(value);
        }
        block.extend(behind.iter().flat_map(|&n| long(n)));
        block
    }

    #[test]
    fn numbers_of_every_type_are_read_in_both_orders() {
        for little in [true, false] {
            let short = if little { [7, 1, 0, 0] } else { [1, 7, 0, 0] };
            let at = |n: u32| {
                if little {
                    n.to_le_bytes()
                } else {
                    n.to_be_bytes()
                }
            };
            let end = 10 + 4 * 12;
            let entries = [
                (1, 1, 1, [9, 0, 0, 0]),
                (2, 3, 1, short),
                (3, 4, 1, at(70_000)),
                (4, 5, 1, at(end)),
            ];
            let block = block(little, &entries, &[21, 4]);
            let exif = Exif::new(&block).unwrap();
            let read: Vec<f64> = (1..5).map(|tag| exif.of_picture(tag).unwrap()).collect();
            assert_eq!(read, [9.0, 263.0, 70_000.0, 5.25]);
            assert_eq!(exif.of_picture(5), None);
            assert_eq!(exif.of_exposure(1), None);
        }
    }

    #[test]
    fn what_is_cut_short_or_points_nowhere_has_no_numbers() {
        let far = u32::MAX.to_le_bytes();
        let entries = [
            (1, 5, 1, far),
            (2, 3, 0, far),
            (3, 2, 1, far),
            (4, 3, 9, far),
            (0x8769, 4, 1, far),
        ];
        let whole = block(true, &entries, &[]);
        for length in 0..=whole.len() {
            let Some(exif) = Exif::new(&whole[..length]) else {
                continue;
            };
            for tag in 1..5 {
                assert_eq!(exif.of_picture(tag), None);
                assert_eq!(exif.of_exposure(tag), None);
            }
        }
    }
}
