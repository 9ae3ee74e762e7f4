//! Masks as COCO's run-length codes: lengths of runs of 0 and 1 in turn, beginning with 0, down the columns.

use std::collections::HashMap;

use fog_dataset::Mask;

/// The runs of one instance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Runs {
    /// Lengths, of 0 first. All but the first and the last are above 0.
    counts: Vec<u32>,
    /// Where the last run ends.
    end: u32,
}

/// The runs of every instance of a mask by its number, 0 left out, in one pass.
pub(crate) fn runs(mask: &Mask) -> HashMap<u16, Runs> {
    let mut all: HashMap<u16, Runs> = HashMap::new();
    let (width, height) = (mask.width as usize, mask.height as usize);
    let mut current = (0u16, 0u32);
    let mut at = 0u32;
    let mut close = |(value, start): (u16, u32), end: u32| {
        if value != 0 && end > start {
            let runs = all.entry(value).or_default();
            runs.counts.extend([start - runs.end, end - start]);
            runs.end = end;
        }
    };
    for x in 0..width {
        for y in 0..height {
            let value = mask.values[y * width + x];
            if value != current.0 {
                close(current, at);
                current = (value, at);
            }
            at += 1;
        }
    }
    close(current, at);
    for runs in all.values_mut().filter(|runs| runs.end < at) {
        runs.counts.push(at - runs.end);
    }
    all
}

impl Runs {
    /// Pixels of the instance.
    pub(crate) fn area(&self) -> u64 {
        self.counts.iter().skip(1).step_by(2).map(|&n| u64::from(n)).sum()
    }

    /// COCO's text of the counts: from the fourth on differences with the one before the last, in groups of five bits from the
    /// lowest on, each a character from `0` on, with a bit that tells of more (pycocotools, `maskApi.c`).
    pub(crate) fn compressed(&self) -> String {
        let mut text = String::new();
        for (i, &count) in self.counts.iter().enumerate() {
            let before = if i > 2 { i64::from(self.counts[i - 2]) } else { 0 };
            let mut rest = i64::from(count) - before;
            loop {
                let low = (rest & 0x1f) as u8;
                rest >>= 5;
                let more = if low & 0x10 == 0 { rest != 0 } else { rest != -1 };
                text.push(char::from(48 + (low | if more { 0x20 } else { 0 })));
                if !more {
                    break;
                }
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_go_down_the_columns_and_cover_the_image() {
        let values = vec![1, 1, 0, 1, 2, 2, 0, 0, 2];
        let all = runs(&Mask { width: 3, height: 3, values });
        assert_eq!(all[&1].counts, [0, 2, 1, 1, 5]);
        assert_eq!(all[&2].counts, [4, 1, 2, 2]);
        assert_eq!((all[&1].area(), all[&2].area(), all.len()), (3, 3, 2));
        assert_eq!(all[&1].compressed(), "021O4");
    }
}
