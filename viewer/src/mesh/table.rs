//! A hash table of numbered items, for finding equal ones.
//!
//! The standard library's maps are several times slower here, and their order differs from run to run.

use super::NONE;

/// Items are numbered from 0 in order of insertion; what they are, the caller keeps.
pub(super) struct Table {
    /// Per bucket the latest item, or `NONE`.
    heads: Vec<u32>,
    /// Per item its stirred key, and the item before it in its bucket.
    items: Vec<(u64, u32)>,
    shift: u32,
}

impl Table {
    /// For about `expected` items; it grows with more.
    pub(super) fn new(expected: usize) -> Self {
        let bits = expected.max(8).next_power_of_two().trailing_zeros();
        Self { heads: vec![NONE; 1 << bits], items: Vec::new(), shift: 64 - bits }
    }

    /// The item of this key for which `same` holds.
    pub(super) fn find(&self, key: u64, mut same: impl FnMut(u32) -> bool) -> Option<u32> {
        let key = mix(key);
        let mut item = self.heads[(key >> self.shift) as usize];
        while item != NONE {
            let (other, before) = self.items[item as usize];
            if other == key && same(item) {
                return Some(item);
            }
            item = before;
        }
        None
    }

    /// Adds the next item.
    pub(super) fn insert(&mut self, key: u64) -> u32 {
        if self.items.len() > 2 * self.heads.len() {
            self.grow();
        }
        let (key, item) = (mix(key), self.items.len() as u32);
        let head = &mut self.heads[(key >> self.shift) as usize];
        self.items.push((key, *head));
        *head = item;
        item
    }

    /// The item for which `same` holds, else a new one; and whether it is new.
    pub(super) fn find_or_insert(&mut self, key: u64, same: impl FnMut(u32) -> bool) -> (u32, bool) {
        match self.find(key, same) {
            Some(item) => (item, false),
            None => (self.insert(key), true),
        }
    }

    fn grow(&mut self) {
        self.shift -= 2;
        self.heads = vec![NONE; self.heads.len() * 4];
        for (item, (key, before)) in self.items.iter_mut().enumerate() {
            let head = &mut self.heads[(*key >> self.shift) as usize];
            *before = std::mem::replace(head, item as u32);
        }
    }
}

/// Stirs a key so that its high bits depend on all bits (finaliser of MurmurHash3, Appleby 2011).
fn mix(key: u64) -> u64 {
    let key = (key ^ (key >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    (key ^ (key >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53)
}

/// One key of several numbers; the table stirs it.
pub(super) fn join(parts: &[u32]) -> u64 {
    parts.iter().fold(0, |key: u64, &part| (key.rotate_left(29) ^ u64::from(part)).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_items_are_found_among_many_of_one_key() {
        let items = [3_u32, 5, 3, 7, 5, 3];
        let mut table = Table::new(2);
        let mut kept: Vec<u32> = Vec::new();
        let mut numbers = Vec::new();
        for item in items {
            let (number, new) = table.find_or_insert(1, |other| kept[other as usize] == item);
            if new {
                kept.push(item);
            }
            numbers.push(number);
        }
        assert_eq!(kept, [3, 5, 7]);
        assert_eq!(numbers, [0, 1, 0, 2, 1, 0]);
    }
}
