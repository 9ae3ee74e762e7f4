//! Messages of Protocol Buffers, as they are on the wire, and their description.

use super::schema::{MESSAGES, Step};

/// A message being put together, field by field.
#[derive(Clone, Debug, Default)]
pub(super) struct Message(Vec<u8>);

impl Message {
    pub(super) fn bytes(mut self, field: u32, value: &[u8]) -> Self {
        self.key(field, 2);
        self.varint(value.len() as u64);
        self.0.extend(value);
        self
    }

    pub(super) fn text(self, field: u32, value: &str) -> Self {
        self.bytes(field, value.as_bytes())
    }

    pub(super) fn message(self, field: u32, value: &Self) -> Self {
        self.bytes(field, &value.0)
    }

    pub(super) fn number(mut self, field: u32, value: u64) -> Self {
        self.key(field, 0);
        self.varint(value);
        self
    }

    pub(super) fn fixed(mut self, field: u32, value: u32) -> Self {
        self.key(field, 5);
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn double(mut self, field: u32, value: f64) -> Self {
        self.key(field, 1);
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn doubles(self, field: u32, values: &[f64]) -> Self {
        let packed: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.bytes(field, &packed)
    }

    pub(super) fn finish(self) -> Vec<u8> {
        self.0
    }

    fn key(&mut self, field: u32, wire: u32) {
        self.varint(u64::from(field << 3 | wire));
    }

    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }
}

/// The `FileDescriptorSet` of all messages (`google/protobuf/descriptor.proto`).
pub(super) fn descriptors() -> Vec<u8> {
    let times = ["timestamp", "duration"].into_iter().zip(["Timestamp", "Duration"]);
    let mut set = Message::default();
    for (file, name) in times {
        let message = descriptor(name, "seconds=1 int64, nanos=2 int32");
        let file = format!("google/protobuf/{file}.proto");
        let file = Message::default()
            .text(1, &file)
            .text(2, "google.protobuf")
            .message(4, &message)
            .text(12, "proto3");
        set = set.message(1, &file);
    }
    let mut own = Message::default().text(1, "foxglove.proto").text(2, "foxglove");
    own = own.text(3, "google/protobuf/timestamp.proto").text(3, "google/protobuf/duration.proto");
    for (name, fields) in MESSAGES {
        own = own.message(4, &descriptor(name, fields));
    }
    set.message(1, &own.text(12, "proto3")).finish()
}

/// `DescriptorProto` of a message from its line in [`MESSAGES`].
fn descriptor(of: &str, fields: &str) -> Message {
    let mut message = Message::default().text(1, of);
    for step in Step::all(fields) {
        message = match step {
            Step::Field { name, number, kind, repeated } => {
                let label = if repeated { 3 } else { 1 };
                let mut field = Message::default().text(1, name).number(3, number).number(4, label);
                field = match kind {
                    "double" => field.number(5, 1),
                    "int64" => field.number(5, 3),
                    "int32" => field.number(5, 5),
                    "fixed32" => field.number(5, 7),
                    "bool" => field.number(5, 8),
                    "string" => field.number(5, 9),
                    "bytes" => field.number(5, 12),
                    "Type" => field.number(5, 14).text(6, &format!(".foxglove.{of}.Type")),
                    "Timestamp" | "Duration" => {
                        field.number(5, 11).text(6, &format!(".google.protobuf.{kind}"))
                    }
                    _ => field.number(5, 11).text(6, &format!(".foxglove.{kind}")),
                };
                message.message(2, &field)
            }
            Step::Choice(names) => {
                let mut choice = Message::default().text(1, "Type");
                for (number, name) in names.split('|').enumerate() {
                    choice = choice.message(2, &Message::default().text(1, name).number(2, number as u64));
                }
                message.message(4, &choice)
            }
        };
    }
    message
}
