//! The JSON Schema names what the parser accepts.

use serde_json::Value;

/// The definition that a schema node stands for.
fn resolve<'s>(root: &'s Value, node: &'s Value) -> &'s Value {
    match node["$ref"].as_str() {
        Some(reference) => root.pointer(reference.trim_start_matches('#')).unwrap(),
        None => node,
    }
}

#[test]
fn ranges_and_units_are_in_the_schema() {
    let schema = fog_plan::schema_json();
    let properties = &schema["properties"];
    let camera = resolve(&schema, &properties["camera"]);
    assert_eq!(camera["properties"]["altitude_m"]["minimum"], -500.0);
    assert_eq!(camera["properties"]["altitude_m"]["default"], 2.0);
    assert!(camera["properties"]["altitude_m"]["description"].as_str().unwrap().contains("metres"));
    assert_eq!(camera["additionalProperties"], false);
    let sensor = resolve(&schema, &properties["sensor"]);
    assert_eq!(sensor["properties"]["width_px"]["maximum"], 16384.0);
    assert_eq!(schema["required"], serde_json::json!(["version", "name"]));
}

#[test]
fn phases_with_and_without_values_are_in_the_schema() {
    let schema = fog_plan::schema_json();
    let phase = resolve(&schema, &schema["$defs"]["Fog"]["properties"]["phase"]);
    let phase = phase["oneOf"].as_array().unwrap();
    assert!(phase.iter().any(|p| p["const"] == "jendersie_deon"), "{phase:?}");
    let key = |name: &str| {
        let with = phase.iter().find(|p| p["properties"].get(name).is_some());
        &with.unwrap_or_else(|| panic!("no {name} in {phase:?}"))["properties"][name]
    };
    let fit = resolve(&schema, &key("jendersie_deon")["anyOf"][0]);
    assert_eq!(fit["properties"]["diameter_um"]["maximum"], 50.0);
    let hg = resolve(&schema, key("hg"));
    assert_eq!(hg["anyOf"][0]["maximum"], 0.999);
    assert!(schema.to_string().contains("\"layer\""));
}
