//! The card of a data set on Hugging Face's hub.

use fog_dataset::Header;
use serde_json::json;

use super::column::Column;

/// Sizes as the hub sorts data sets by, and from how many rows on.
const SIZES: [(u64, &str); 5] = [
    (0, "n<1K"),
    (1_000, "1K<n<10K"),
    (10_000, "10K<n<100K"),
    (100_000, "100K<n<1M"),
    (1_000_000, "1M<n<10M"),
];

/// `README.md`: metadata as YAML, then what the columns are.
pub(super) fn text(header: &Header, columns: &[Column], frames: u64) -> String {
    let size = SIZES.iter().rev().find(|(from, _)| frames >= *from).map_or("n<1K", |(_, size)| size);
    // A string of JSON is one of YAML.
    let name = json!(header.name);
    let rows: String = columns.iter().map(|c| format!("| `{}` | {} |\n", c.name, c.about)).collect();
    format!(
        "---\n\
         pretty_name: {name}\n\
         tags: [fog, synthetic, computer-vision, fogbank]\n\
         size_categories: [\"{size}\"]\n\
         configs:\n\
         - config_name: default\n  data_files:\n  - split: train\n    path: \"data/train-*.parquet\"\n\
         ---\n\n\
         # {}\n\n\
         {frames} frames rendered in fog by Fogbank. Configuration `{}`, code `{}`.\n\n\
         ```python\n\
         from datasets import load_dataset\n\
         frames = load_dataset(\"parquet\", data_files=\"data/train-*.parquet\", split=\"train\")\n\
         ```\n\n\
         | column | content |\n|---|---|\n{rows}",
        header.name, header.config_digest, header.code_digest,
    )
}
