//! Names with stars.

/// True if `name` is `pattern` with each `*` replaced by some text.
pub(crate) fn fits(pattern: &str, name: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut left) = name.strip_prefix(first) else { return false };
    let mut parts = rest.split('*').peekable();
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return left.ends_with(part);
        }
        let Some(at) = left.find(part) else { return false };
        left = &left[at + part.len()..];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_text() {
        for (pattern, name, want) in [
            ("lamp", "lamp", true),
            ("lamp", "lamp 1", false),
            ("lamp*", "lamp 1", true),
            ("*lamp", "street lamp", true),
            ("*lamp", "lamp 1", false),
            ("s*t*p", "street lamp", true),
            ("s*t*t*t*p", "street lamp", false),
            ("*", "", true),
            ("ab*ba", "aba", false),
            ("*é*", "café au lait", true),
        ] {
            assert_eq!(fits(pattern, name), want, "{pattern} {name}");
        }
    }
}
