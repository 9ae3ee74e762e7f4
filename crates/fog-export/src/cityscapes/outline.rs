//! Outlines of areas of equal value, through the centres of their outer pixels.

/// One connected area's outline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    pub(super) value: u16,
    /// Columns and rows, clockwise from the first pixel of the uppermost row; three at least.
    pub(super) points: Vec<[i32; 2]>,
    /// Twice the area of the polygon of pixels' outer edges: holes count as well.
    pub(super) twice_area: u64,
}

/// The eight neighbours, clockwise from the right one.
const AROUND: [[i32; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

/// Outlines of all areas whose pixels touch by edges or corners.
pub(super) fn outlines(values: &[u16], size: [u32; 2]) -> Vec<Outline> {
    let grid = Grid { values, width: size[0] as i32, height: size[1] as i32 };
    let mut seen = vec![false; values.len()];
    let mut all = Vec::new();
    for start in 0..values.len() {
        if !seen[start] {
            let at = [start as i32 % grid.width, start as i32 / grid.width];
            grid.flood(at, &mut seen);
            all.push(grid.trace(at));
        }
    }
    all
}

struct Grid<'a> {
    values: &'a [u16],
    width: i32,
    height: i32,
}

impl Grid<'_> {
    fn get(&self, [x, y]: [i32; 2]) -> Option<u16> {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        inside.then(|| self.values[(y * self.width + x) as usize])
    }

    /// Marks the area of a pixel.
    fn flood(&self, start: [i32; 2], seen: &mut [bool]) {
        let value = self.get(start);
        let mut stack = vec![start];
        while let Some([x, y]) = stack.pop() {
            let index = (y * self.width + x) as usize;
            if std::mem::replace(&mut seen[index], true) {
                continue;
            }
            for [dx, dy] in AROUND {
                let next = [x + dx, y + dy];
                if self.get(next) == value && !seen[(next[1] * self.width + next[0]) as usize] {
                    stack.push(next);
                }
            }
        }
    }

    /// Follows the outer border clockwise from the area's first pixel in reading order, the outside on the left.
    fn trace(&self, start: [i32; 2]) -> Outline {
        let value = self.get(start);
        // Above and to the left of the first pixel there is nothing of the area: look clockwise from the left neighbour on.
        let step = |at: [i32; 2], from: usize| {
            (0..8).map(|k| (from + k) % 8).find_map(|k| {
                let next = [at[0] + AROUND[k][0], at[1] + AROUND[k][1]];
                (self.get(next) == value).then_some((next, k))
            })
        };
        let mut points = vec![start];
        if let Some((second, first_way)) = step(start, 4) {
            let (mut at, mut way) = (second, first_way);
            // The next look begins beside the pixel that one comes from, on the left.
            while let Some((next, next_way)) = step(at, (way + 6 - way % 2) % 8) {
                if at == start && next == second {
                    break;
                }
                // Points inside of a straight line are left out.
                if next_way != way || at == start {
                    points.push(at);
                }
                (at, way) = (next, next_way);
            }
        }
        let twice_area = twice_area(&points) + 2 * points.len() as u64;
        while points.len() < 3 {
            points.push(points[points.len() - 1]);
        }
        Outline { value: value.unwrap_or_default(), points, twice_area }
    }
}

/// Twice the area within a polygon.
fn twice_area(points: &[[i32; 2]]) -> u64 {
    let next = points.iter().cycle().skip(1);
    let cross = |([ax, ay], [bx, by]): (&[i32; 2], &[i32; 2])| {
        i64::from(*ax) * i64::from(*by) - i64::from(*bx) * i64::from(*ay)
    };
    points.iter().zip(next).map(cross).sum::<i64>().unsigned_abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_go_around_areas_and_over_their_holes() {
        #[rustfmt::skip]
        let values = [
            1, 1, 1, 1, 0,
            1, 2, 1, 1, 0,
            1, 1, 1, 1, 3,
        ];
        let all = outlines(&values, [5, 3]);
        let of = |value: u16| all.iter().find(|o| o.value == value).expect("an outline").points.clone();
        assert_eq!(of(1), [[0, 0], [3, 0], [3, 2], [0, 2]]);
        assert_eq!(of(2), [[1, 1]; 3]);
        assert_eq!(of(3), [[4, 2]; 3]);
        assert_eq!(of(0), [[4, 0], [4, 1], [4, 1]]);
        assert_eq!(all.len(), 4);
        let area = |value: u16| all.iter().find(|o| o.value == value).expect("an outline").twice_area;
        assert!(area(1) > area(2));
    }

    #[test]
    fn lines_that_are_one_pixel_wide_are_followed_to_their_end_and_back() {
        #[rustfmt::skip]
        let values = [
            0, 1, 0,
            1, 0, 0,
            0, 1, 1,
        ];
        let all = outlines(&values, [3, 3]);
        let one = all.iter().find(|o| o.value == 1).expect("an outline");
        for pixel in [[1, 0], [0, 1], [2, 2]] {
            assert!(one.points.contains(&pixel), "{:?}", one.points);
        }
    }
}
