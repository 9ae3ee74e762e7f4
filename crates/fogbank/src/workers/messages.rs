//! Lines of JSON over a pipe, in pieces as they come.

use crate::work::Report;

/// Collects bytes and gives whole lines.
#[derive(Debug, Default)]
pub(super) struct Lines {
    rest: Vec<u8>,
}

impl Lines {
    /// Takes what was read; gives the reports that are whole now. A line that is none, which only a dying process writes, is
    /// passed over.
    pub(super) fn take(&mut self, bytes: &[u8]) -> Vec<Report<'static>> {
        self.rest.extend_from_slice(bytes);
        let end = self.rest.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let whole: Vec<u8> = self.rest.drain(..end).collect();
        whole.split(|&b| b == b'\n').filter_map(|line| serde_json::from_slice(line).ok()).collect()
    }
}

/// A report as a line.
pub(super) fn line(report: &Report<'_>) -> Vec<u8> {
    let mut line = serde_json::to_vec(report).unwrap_or_default();
    line.push(b'\n');
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_cross_in_pieces() {
        let sent = [
            Report::Traced(3),
            Report::Failed { frame: 1, reason: "a\nb".into() },
            Report::Done { frame: 2, seconds: 0.5, noise: 0.1 },
            Report::Through,
        ];
        let bytes: Vec<u8> = sent.iter().flat_map(line).collect();
        let mut lines = Lines::default();
        let heard: Vec<_> = bytes.chunks(7).flat_map(|piece| lines.take(piece)).collect();
        assert_eq!(heard, sent);
    }
}
