//! Three channels at every pixel of a mosaic, by the gradient-corrected linear filters of Malvar, He & Cutler 2004,
//! "High-quality linear interpolation for demosaicing of Bayer-patterned color images", ICASSP.

use crate::bayer::Bayer;
use fog_core::colour::Rgb;

/// Weights of pixels at (dx, dy), in eighths; each of the four filters is symmetric in both axes.
type Filter = &'static [(isize, isize, f32)];

/// Green at red and blue pixels.
const GREEN: Filter = &[
    (0, 0, 4.0),
    (1, 0, 2.0),
    (-1, 0, 2.0),
    (0, 1, 2.0),
    (0, -1, 2.0),
    (2, 0, -1.0),
    (-2, 0, -1.0),
    (0, 2, -1.0),
    (0, -2, -1.0),
];
/// Red or blue at a green pixel whose row has that colour.
const IN_ROW: Filter = &[
    (0, 0, 5.0),
    (1, 0, 4.0),
    (-1, 0, 4.0),
    (2, 0, -1.0),
    (-2, 0, -1.0),
    (1, 1, -1.0),
    (-1, 1, -1.0),
    (1, -1, -1.0),
    (-1, -1, -1.0),
    (0, 2, 0.5),
    (0, -2, 0.5),
];
/// Red or blue at a green pixel whose column has that colour.
const IN_COLUMN: Filter = &[
    (0, 0, 5.0),
    (0, 1, 4.0),
    (0, -1, 4.0),
    (0, 2, -1.0),
    (0, -2, -1.0),
    (1, 1, -1.0),
    (-1, 1, -1.0),
    (1, -1, -1.0),
    (-1, -1, -1.0),
    (2, 0, 0.5),
    (-2, 0, 0.5),
];
/// Red at blue pixels and blue at red ones.
const ACROSS: Filter = &[
    (0, 0, 6.0),
    (1, 1, 2.0),
    (-1, 1, 2.0),
    (1, -1, 2.0),
    (-1, -1, 2.0),
    (2, 0, -1.5),
    (-2, 0, -1.5),
    (0, 2, -1.5),
    (0, -2, -1.5),
];

/// Index of a pixel beyond the edge: mirrored about the outermost pixel, so that its colour is that of the place it stands for.
fn mirrored(i: isize, n: usize) -> usize {
    let period = 2 * (n as isize - 1);
    if period == 0 {
        return 0;
    }
    let i = i.rem_euclid(period);
    i.min(period - i) as usize
}

/// Red, green and blue of every pixel of a mosaic of `width` × `height` values (row-major). A value is kept in its own channel; the
/// filters are linear, so that even colours come back exactly, and so may overshoot at edges. The picture is mirrored at its
/// edges.
///
/// # Panics
/// When there are not width × height values.
#[must_use]
pub fn demosaic(mosaic: &[f32], width: usize, height: usize, bayer: Bayer) -> Vec<Rgb> {
    assert_eq!(mosaic.len(), width * height, "one value per pixel");
    let filtered = |x: usize, y: usize, filter: Filter| {
        let inner = (2..width.saturating_sub(2)).contains(&x) && (2..height.saturating_sub(2)).contains(&y);
        let (x, y) = (x as isize, y as isize);
        let mut sum = 0.0;
        for &(dx, dy, weight) in filter {
            let (at_x, at_y) = (x + dx, y + dy);
            let (at_x, at_y) = if inner {
                (at_x as usize, at_y as usize)
            } else {
                (mirrored(at_x, width), mirrored(at_y, height))
            };
            sum += weight * mosaic[at_y * width + at_x];
        }
        sum / 8.0
    };
    let mut out = Vec::with_capacity(mosaic.len());
    for y in 0..height {
        for x in 0..width {
            let own = bayer.channel(x, y);
            let mut rgb = [0.0; 3];
            if own == 1 {
                let in_row = bayer.channel(x + 1, y);
                rgb[in_row] = filtered(x, y, IN_ROW);
                rgb[2 - in_row] = filtered(x, y, IN_COLUMN);
            } else {
                rgb[1] = filtered(x, y, GREEN);
                rgb[2 - own] = filtered(x, y, ACROSS);
            }
            rgb[own] = mosaic[y * width + x];
            out.push(rgb);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mosaic(width: usize, height: usize, bayer: Bayer, rgb: impl Fn(usize, usize) -> Rgb) -> Vec<f32> {
        (0..width * height)
            .map(|i| {
                let (x, y) = (i % width, i / width);
                rgb(x, y)[bayer.channel(x, y)]
            })
            .collect()
    }

    #[test]
    fn even_colours_come_back_exactly() {
        for bayer in Bayer::ALL {
            for (width, height) in [(7, 6), (2, 2), (1, 5), (3, 4)] {
                let colour = [0.25, 0.5, 0.125];
                let field = demosaic(&mosaic(width, height, bayer, |_, _| colour), width, height, bayer);
                // A picture one pixel wide has no pixels of some colours.
                if width > 1 {
                    assert!(
                        field.iter().all(|rgb| *rgb == colour),
                        "{bayer:?} {width} × {height}: {field:?}"
                    );
                }
                let grey = demosaic(&vec![0.7; width * height], width, height, bayer);
                assert!(grey.iter().flatten().all(|v| (v - 0.7).abs() < 1e-6));
            }
        }
    }

    #[test]
    fn grey_ramps_are_linear_inside() {
        for bayer in Bayer::ALL {
            let value = |x: usize, y: usize| 0.5 + 0.25 * x as f32 - 0.125 * y as f32;
            let out = demosaic(&mosaic(12, 10, bayer, |x, y| [value(x, y); 3]), 12, 10, bayer);
            for y in 2..8 {
                for x in 2..10 {
                    assert!(out[y * 12 + x].iter().all(|v| (v - value(x, y)).abs() < 1e-6));
                }
            }
        }
    }

    #[test]
    fn the_filters_are_those_of_the_paper() {
        // Response of each channel around a single bright pixel, and that every filter has the weight 1.
        for filter in [GREEN, IN_ROW, IN_COLUMN, ACROSS] {
            assert_eq!(filter.iter().map(|(_, _, w)| w).sum::<f32>(), 8.0);
        }
        let mut one = vec![0.0; 81];
        one[4 * 9 + 4] = 8.0;
        let out = demosaic(&one, 9, 9, Bayer::Rggb); // (4, 4) is red
        let at = |x: usize, y: usize| out[y * 9 + x];
        assert_eq!(at(4, 4), [8.0, 4.0, 6.0]);
        assert_eq!(at(5, 4), [4.0, 0.0, 0.0]); // green in red's row
        assert_eq!(at(4, 5), [4.0, 0.0, 0.0]);
        assert_eq!(at(5, 5), [2.0, 0.0, 0.0]); // blue
        assert_eq!(at(6, 4), [0.0, -1.0, -1.5]); // red
    }
}
