/// A truth for each of many numbers, one bit each.
#[derive(Debug, Clone)]
pub(super) struct Bits {
    words: Vec<u64>,
}

impl Bits {
    /// All false.
    pub(super) fn none(count: usize) -> Self {
        Self {
            words: vec![0; count.div_ceil(64)],
        }
    }

    /// True where these are not, for so many numbers.
    pub(super) fn others(self, count: usize) -> Self {
        let mut words: Vec<u64> = self.words.into_iter().map(|word| !word).collect();
        if let (Some(last), 1..) = (words.last_mut(), count % 64) {
            *last &= (1 << (count % 64)) - 1;
        }
        Self { words }
    }

    pub(super) fn contains(&self, at: usize) -> bool {
        self.words[at / 64] >> (at % 64) & 1 == 1
    }

    /// Makes one true. Returns whether it was not.
    pub(super) fn insert(&mut self, at: usize) -> bool {
        let word = &mut self.words[at / 64];
        let was = *word;
        *word |= 1 << (at % 64);
        *word != was
    }

    /// How many are true.
    pub(super) fn count(&self) -> usize {
        let ones = self.words.iter().map(|word| word.count_ones() as usize);
        ones.sum()
    }
}
