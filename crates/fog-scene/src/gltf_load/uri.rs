//! URIs of glTF: embedded data, or paths below the scene's folder.

use std::path::{Component, PathBuf};

/// What a URI stands for.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// Bytes in the URI itself.
    Data(Vec<u8>),
    /// A relative path that, links aside, stays in the folder.
    Relative(PathBuf),
}

/// Reads a URI; the error completes the sentence `URI "…" …`.
pub(super) fn parse(uri: &str) -> Result<Target, &'static str> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, data) = data.split_once(";base64,").ok_or("is data, but not in base64")?;
        return base64(data).map(Target::Data).ok_or("is not valid base64");
    }
    let scheme_end = uri.find(|c: char| !c.is_ascii_alphanumeric() && !"+-.".contains(c));
    if scheme_end.is_some_and(|end| end > 0 && uri[end..].starts_with(':')) {
        return Err("has a scheme; only files in the scene's folder and data: are read");
    }
    let path = PathBuf::from(percent_decode(uri).ok_or("is not validly percent-encoded UTF-8")?);
    let mut depth = 0u32;
    for component in path.components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::CurDir => {}
            Component::ParentDir => depth = depth.checked_sub(1).ok_or("leaves the scene's folder")?,
            Component::Prefix(_) | Component::RootDir => {
                return Err("is an absolute path; only files in the scene's folder are read");
            }
        }
    }
    if depth == 0 { Err("names no file") } else { Ok(Target::Relative(path)) }
}

fn percent_decode(text: &str) -> Option<String> {
    let mut out = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte != b'%' {
            out.push(byte);
            continue;
        }
        let digit = |i: usize| char::from(*after.get(i)?).to_digit(16);
        out.push((digit(0)? * 16 + digit(1)?) as u8);
        rest = &after[2..];
    }
    String::from_utf8(out).ok().filter(|s| !s.contains('\0'))
}

/// Base64 with the standard alphabet, with or without padding.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=').as_bytes();
    if text.len() % 4 == 1 {
        return None;
    }
    let mut out = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0u32;
        for &c in group {
            let digit = match c {
                b'A'..=b'Z' => c - b'A',
                b'a'..=b'z' => c - b'a' + 26,
                b'0'..=b'9' => c - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                _ => return None,
            };
            bits = bits << 6 | u32::from(digit);
        }
        bits <<= 6 * (4 - group.len());
        out.extend(&bits.to_be_bytes()[1..group.len()]);
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_decodes_every_length() {
        for (text, bytes) in
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm8", "fo"), ("Zm9v", "foo"), ("Zm9vYg==", "foob")]
        {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64("+/+/"), Some(vec![0xfb, 0xff, 0xbf]));
        assert!(base64("A").is_none() && base64("Zm9*").is_none());
    }

    #[test]
    fn paths_stay_inside() {
        let relative = |p: &str| Ok(Target::Relative(p.into()));
        assert_eq!(parse("a%20b/c.bin"), relative("a b/c.bin"));
        assert_eq!(parse("a/../c.bin"), relative("a/../c.bin"));
        for (uri, reason) in [
            ("../c.bin", "leaves"),
            ("a/../../c.bin", "leaves"),
            ("%2e%2e/c.bin", "leaves"),
            ("/etc/passwd", "absolute"),
            ("%2Fetc/passwd", "absolute"),
            ("file:///etc/passwd", "scheme"),
            ("http://example.org/a.bin", "scheme"),
            ("", "no file"),
            ("a/..", "no file"),
            ("a%2", "percent"),
            ("a%zz", "percent"),
            ("a%ff", "percent"),
            ("a%00", "percent"),
            ("data:text/plain,hello", "base64"),
        ] {
            let error = parse(uri).expect_err(uri);
            assert!(error.contains(reason), "{uri}: {error}");
        }
    }
}
