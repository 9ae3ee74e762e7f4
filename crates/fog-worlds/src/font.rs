//! Letters drawn as lines of one width, after the plain alphabets of road signs.
//!
//! A letter is 7 units high and its lines 1 unit wide: the centre lines run from 0.5 to 6.5. Letters are written in a small
//! path language: `M x,y` starts a line, `L x,y` goes on straight, `A cx,cy,rx,ry,a,b` goes along an ellipse from a° to b°
//! (0 right, 90 up).

use crate::place::sin_cos;

/// Height of a letter in its own units.
const HEIGHT: f32 = 7.0;
/// Space between letters, and width of a space.
const GAP: f32 = 1.0;
const SPACE: f32 = 2.6;
/// Degrees between points of an arc.
const ARC_STEP: f32 = 10.0;

/// Width and path of a letter; `None` if there is no such letter.
fn glyph(letter: char) -> Option<(f32, &'static str)> {
    Some(match letter.to_ascii_uppercase() {
        'A' => (5.0, "M.5,.5 L2.5,6.5 L4.5,.5 M1.2,2.4 L3.8,2.4"),
        'B' => (
            4.6,
            "M.5,.5 L.5,6.5 L2.5,6.5 A2.5,5.1,1.4,1.4,90,-90 L.5,3.7 M2.5,3.7 A2.5,2.1,1.6,1.6,90,-90 L.5,.5",
        ),
        'C' => (4.6, "M4.1,5.2 A2.3,4.7,1.8,1.8,20,180 L.5,2.3 A2.3,2.3,1.8,1.8,180,340"),
        'D' => (4.6, "M.5,.5 L.5,6.5 L2,6.5 A2,4.4,2.1,2.1,90,0 L4.1,2.6 A2,2.6,2.1,2.1,0,-90 L.5,.5"),
        'E' => (4.2, "M3.7,6.5 L.5,6.5 L.5,.5 L3.7,.5 M.5,3.6 L3.2,3.6"),
        'F' => (4.0, "M3.5,6.5 L.5,6.5 L.5,.5 M.5,3.6 L3.1,3.6"),
        'G' => (4.8, "M4.1,5.3 A2.4,4.6,1.9,1.9,30,180 L.5,2.4 A2.4,2.4,1.9,1.9,180,360 L4.3,3.2 L2.6,3.2"),
        'H' => (4.8, "M.5,.5 L.5,6.5 M4.3,.5 L4.3,6.5 M.5,3.6 L4.3,3.6"),
        'I' => (1.0, "M.5,.5 L.5,6.5"),
        'J' => (3.8, "M3.3,6.5 L3.3,2 A1.8,2,1.5,1.5,0,-170"),
        'K' => (4.6, "M.5,.5 L.5,6.5 M4.1,6.5 L.7,2.6 M1.9,3.9 L4.2,.5"),
        'L' => (4.0, "M.5,6.5 L.5,.5 L3.6,.5"),
        'M' => (5.6, "M.5,.5 L.5,6.5 L2.8,2 L5.1,6.5 L5.1,.5"),
        'N' => (4.8, "M.5,.5 L.5,6.5 L4.3,.5 L4.3,6.5"),
        'O' => (4.8, "M.5,2.4 A2.4,4.6,1.9,1.9,180,0 L4.3,2.4 A2.4,2.4,1.9,1.9,0,-180"),
        'P' => (4.4, "M.5,.5 L.5,6.5 L2.3,6.5 A2.3,4.9,1.6,1.6,90,-90 L.5,3.3"),
        'Q' => (4.8, "M.5,2.4 A2.4,4.6,1.9,1.9,180,0 L4.3,2.4 A2.4,2.4,1.9,1.9,0,-180 M2.7,2 L4.4,.4"),
        'R' => (4.6, "M.5,.5 L.5,6.5 L2.4,6.5 A2.4,4.9,1.6,1.6,90,-90 L.5,3.3 M2.3,3.3 L4.1,.5"),
        'S' => (4.4, "M3.8,5.4 A2.2,5.05,1.65,1.45,15,270 A2.2,2.1,1.7,1.55,90,-165"),
        'T' => (4.4, "M.5,6.5 L3.9,6.5 M2.2,6.5 L2.2,.5"),
        'U' => (4.8, "M.5,6.5 L.5,2.4 A2.4,2.4,1.9,1.9,180,360 L4.3,6.5"),
        'V' => (5.0, "M.5,6.5 L2.5,.5 L4.5,6.5"),
        'W' => (6.6, "M.5,6.5 L1.9,.5 L3.3,5.4 L4.7,.5 L6.1,6.5"),
        'X' => (4.8, "M.5,.5 L4.3,6.5 M.5,6.5 L4.3,.5"),
        'Y' => (4.8, "M.5,6.5 L2.4,3.2 L4.3,6.5 M2.4,3.2 L2.4,.5"),
        'Z' => (4.4, "M.5,6.5 L3.9,6.5 L.5,.5 L3.9,.5"),
        '0' => (4.4, "M.5,2.2 A2.2,4.8,1.7,1.7,180,0 L3.9,2.2 A2.2,2.2,1.7,1.7,0,-180"),
        '1' => (2.6, "M.5,5.2 L2.1,6.5 L2.1,.5"),
        '2' => (4.4, "M.6,5 A2.2,4.8,1.65,1.7,165,-35 L.5,.5 L4,.5"),
        '3' => (4.4, "M.7,5.4 A2.1,5.1,1.45,1.4,150,-90 L1.7,3.7 M2.1,3.7 A2.1,2.1,1.7,1.6,90,-155"),
        '4' => (4.8, "M3.3,.5 L3.3,6.5 L.5,2 L4.4,2"),
        '5' => (4.4, "M3.7,6.5 L.9,6.5 L.7,3.6 A2.1,2.4,1.8,1.9,135,-150"),
        '6' => (4.4, "M3.7,5.6 A2.3,4.7,1.75,1.8,35,180 L.5,2.3 A2.2,2.3,1.7,1.8,180,-180"),
        '7' => (4.2, "M.5,6.5 L3.8,6.5 L1.7,.5"),
        '8' => (4.4, "M2.2,3.7 A2.2,5.1,1.5,1.4,-90,270 A2.2,2.1,1.7,1.6,90,-270"),
        '9' => (4.4, "M.7,1.4 A2.1,2.3,1.75,1.8,215,360 L3.9,4.7 A2.2,4.7,1.7,1.8,0,360"),
        '-' => (2.8, "M.5,3.3 L2.3,3.3"),
        '.' => (1.0, "M.5,.5 L.5,.51"),
        ':' => (1.0, "M.5,1.2 L.5,1.21 M.5,4.6 L.5,4.61"),
        '/' => (3.6, "M.5,.2 L3.1,6.8"),
        '^' => (5.4, "M2.7,.5 L2.7,6.4 M.6,4.2 L2.7,6.4 L4.8,4.2"),
        ' ' => (SPACE - GAP, ""),
        _ => return None,
    })
}

/// Lines of a text of letter height 7 with its lower left corner at the origin, and its width. Letters that the alphabet
/// lacks are left out.
pub(crate) fn lines(text: &str) -> (Vec<Vec<[f32; 2]>>, f32) {
    let mut all = Vec::new();
    let mut x = 0.0;
    for (width, path) in text.chars().filter_map(glyph) {
        if x > 0.0 {
            x += GAP;
        }
        all.extend(parse(path).into_iter().map(|line| line.into_iter().map(|[a, b]| [x + a, b]).collect()));
        x += width;
    }
    (all, x)
}

/// The text's lines, letters `height` high, with the middle of its box at `centre`, and half the width of the lines.
pub(crate) fn centred(text: &str, centre: [f32; 2], height: f32) -> (Vec<Vec<[f32; 2]>>, f32) {
    let (all, width) = lines(text);
    let scale = height / HEIGHT;
    let place =
        |[x, y]: [f32; 2]| [centre[0] + scale * (x - 0.5 * width), centre[1] + scale * (y - 0.5 * HEIGHT)];
    (all.into_iter().map(|line| line.into_iter().map(place).collect()).collect(), 0.5 * scale)
}

/// Width of a text whose letters are `height` high.
pub(crate) fn width(text: &str, height: f32) -> f32 {
    lines(text).1 * height / HEIGHT
}

fn parse(path: &str) -> Vec<Vec<[f32; 2]>> {
    let mut out: Vec<Vec<[f32; 2]>> = Vec::new();
    for word in path.split_whitespace() {
        let (kind, rest) = word.split_at(1);
        let numbers: Vec<f32> = rest.split(',').filter_map(|n| n.parse().ok()).collect();
        match (kind, numbers.as_slice()) {
            ("M", &[x, y]) => out.push(vec![[x, y]]),
            ("L", &[x, y]) => out.last_mut().into_iter().for_each(|line| line.push([x, y])),
            ("A", &[cx, cy, rx, ry, from, to]) => {
                let steps = ((to - from).abs() / ARC_STEP).ceil().max(1.0) as usize;
                let point = |k: usize| {
                    let (s, c) = sin_cos(from + (to - from) * k as f32 / steps as f32);
                    [cx + rx * c, cy + ry * s]
                };
                out.last_mut().into_iter().for_each(|line| line.extend((0..=steps).map(point)));
            }
            _ => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_lies_in_its_box() {
        for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.:/^".chars() {
            let (width, path) = glyph(letter).unwrap();
            let numbers: usize = path.split_whitespace().count();
            let lines = parse(path);
            assert!(!lines.is_empty() && numbers > 0, "{letter}");
            for [x, y] in lines.into_iter().flatten() {
                assert!((0.3..=width - 0.3).contains(&x) && (0.0..=7.0).contains(&y), "{letter}: {x}, {y}");
            }
        }
        assert!(glyph('é').is_none());
        assert!(width("STOP", 7.0) > 18.0);
    }
}
