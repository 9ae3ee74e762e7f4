//! Colours and sizes that all figures share.

/// Text, and lines that matter as much.
pub(crate) const INK: &str = "#1f252b";
/// Captions and tick labels.
pub(crate) const MUTED: &str = "#55606b";
/// Frames and ticks.
pub(crate) const FRAME: &str = "#8d97a1";
/// Grid lines.
pub(crate) const GRID: &str = "#e6e9ec";

/// Okabe & Ito's colours for people with any colour vision (2008), the darker ones first; without yellow, which is too
/// light for lines on white.
pub(crate) const PALETTE: [&str; 6] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

/// Size of the title, of labels, of tick labels and legends, and of the caption, in px of a page 1000 px wide.
pub(crate) const TITLE: f64 = 21.0;
pub(crate) const LABEL: f64 = 14.0;
pub(crate) const TICK: f64 = 12.5;
pub(crate) const CAPTION: f64 = 12.0;

/// Colour for 0 ≤ t ≤ 1 of ordered things, from dark violet to light green: stops of the palette viridis (Smith & van der
/// Walt 2015), which ascends in lightness for people with any colour vision; its yellow end is left out.
pub(crate) fn ramp(t: f64) -> String {
    const STOPS: [[f64; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [62.0, 74.0, 137.0],
        [38.0, 130.0, 142.0],
        [53.0, 183.0, 121.0],
        [157.0, 208.0, 53.0],
    ];
    let x = t.clamp(0.0, 1.0) * 4.0;
    let i = (x as usize).min(3);
    let channel = |c: usize| (STOPS[i][c] + (STOPS[i + 1][c] - STOPS[i][c]) * (x - i as f64)).round() as u8;
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}
