"""Exports to WebDataset, Hugging Face and MCAP, read by `webdataset`, `pyarrow`, `mcap` and Foxglove's own message classes.

`datasets` and `rerun-sdk` take too long to install for every run; `docs/export.md` says what they made of the same files."""

import importlib
import io
import json

import numpy as np
import pyarrow.parquet as pq
import pytest
import webdataset
import yaml
from conftest import rendered, run
from fogbank_tools.dataset import plan, read_frame
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.reader import make_reader
from PIL import Image

CONFIG = """
version: 1
name: carriers.v1
scene: {generate: urban, length_m: 80}
fog: none
path: {poses: [{time_s: 0, position_m: [1.6, 1.5, 0]}, {time_s: 0.1, position_m: [1.6, 1.5, -0.4]},
               {time_s: 0.25, position_m: [1.6, 1.5, -1]}]}
sensor: {width_px: 128, height_px: 72}
render: {samples: 2}
outputs: [image, hdr, depth, transmittance, semantic, instance, objects]
sweep:
  axes:
    fog: [none, {model: homogeneous, height_m: 60, sigma_t_1_m: 0.03, phase: {hg: 0.8}}]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return rendered(tmp_path_factory, "carriers", CONFIG)


@pytest.fixture(scope="module")
def export(folder):
    def made(name, again=""):
        out = folder.parent / f"{name}{again}"
        if not out.is_dir():
            run("export", folder, "--format", name, "--out", out, "--quiet", "--shard-size", "1", check=True)
        return out

    return made


@pytest.fixture(scope="module")
def frames(folder):
    lines = plan(folder)
    assert len(lines) == 6
    return [read_frame(folder, line["id"]) for line in lines]


@pytest.mark.parametrize("name", ["webdataset", "huggingface", "mcap"])
def test_the_same_bytes_again(export, name):
    files = [{p.relative_to(out): p.read_bytes() for p in sorted(out.rglob("*")) if p.is_file()}
             for out in (export(name), export(name, "-again"))]
    assert files[0] == files[1] and len(files[0]) > 2


def test_webdataset_reads_the_shards(export, folder, frames):
    shards = sorted(str(p) for p in export("webdataset").glob("*.tar"))
    assert len(shards) > 1 and shards[0].endswith("carriers_v1-000000.tar")
    samples = list(webdataset.WebDataset(shards, shardshuffle=False).decode("rgb8"))
    keys = [sample["__key__"] for sample in samples]
    assert keys == sorted(keys) and len(keys) == 6
    for sample, frame in zip(samples, frames):
        assert sample["json"] == frame.record and sample["objects.json"]["objects"] == frame.objects
        assert (sample["rgb.png"] == frame.image).all()
        for ending in ("gt.exr", "hdr.exr"):
            assert sample[ending] == (folder / f"{frame.id}.{ending}").read_bytes()
        assert {"semantic.png", "instance.png"} < set(sample)


def test_arrow_reads_the_table(export, folder, frames):
    files = sorted(export("huggingface").glob("data/train-*.parquet"))
    assert len(files) > 1
    tables = [pq.read_table(file) for file in files]
    rows = [row for table in tables for row in table.to_pylist()]
    features = json.loads(tables[0].schema.metadata[b"huggingface"])["info"]["features"]
    assert list(features) == tables[0].column_names
    assert features["image"] == features["instance"] == {"_type": "Image"}
    assert features["axis_path_index"] == {"_type": "Value", "dtype": "float64"}
    assert [row["id"] for row in rows] == [frame.id for frame in frames]
    for number, (row, frame) in enumerate(zip(rows, frames)):
        assert row["number"] == number and row["pair_id"] == frame.record["pair_id"]
        assert row["axis_path_index"] == number % 3 and json.loads(row["record"]) == frame.record
        fog = frame.record["axes"]["fog"]
        assert row["axis_fog"] == fog if isinstance(fog, str) else json.loads(row["axis_fog"]) == fog
        assert json.loads(row["objects"])["objects"] == frame.objects
        assert row["image"]["path"] == f"{frame.id}.rgb.png"
        for column, want in (("image", frame.image), ("instance", frame.instance), ("semantic", frame.semantic)):
            assert (np.asarray(Image.open(io.BytesIO(row[column]["bytes"]))) == want).all()
        assert row["gt_exr"] == (folder / f"{frame.id}.gt.exr").read_bytes()
    card = (export("huggingface") / "README.md").read_text()
    head = yaml.safe_load(card.split("---\n")[1])
    assert head["configs"][0]["data_files"] == [{"split": "train", "path": "data/train-*.parquet"}]
    assert head["pretty_name"] == "carriers.v1" and all(f"| `{name}` |" in card for name in features)


def messages(file):
    """Topic, seconds and message of all of a file, by Foxglove's own classes."""
    out = []
    with file.open("rb") as stream:
        for schema, channel, message in make_reader(stream, validate_crcs=True).iter_messages():
            if channel.message_encoding == "json":
                value = json.loads(message.data)
            else:
                name = schema.name.removeprefix("foxglove.")
                module = importlib.import_module(f"foxglove_schemas_protobuf.{name}_pb2")
                value = getattr(module, name).FromString(message.data)
                if name != "SceneUpdate":
                    assert value.timestamp.ToNanoseconds() == message.log_time
            out.append((channel.topic, message.log_time / 1e9, value))
    return out


def test_mcap_has_foxgloves_messages(export, folder, frames):
    files = sorted(export("mcap").glob("*.mcap"))
    assert len(files) == 2, "a file for each path"
    for file, own in zip(files, (frames[:3], frames[3:])):
        found = messages(file)
        by_topic = {topic: [(t, m) for other, t, m in found if other == topic] for topic, _, _ in found}
        topics = {f"/camera/{what}" for what in ("image", "depth", "calibration", "objects", "record")}
        assert set(by_topic) == topics | {"/tf"}
        assert all([t for t, _ in all_] == [0, 0.1, 0.25] for all_ in by_topic.values())
        for i, frame in enumerate(own):
            of = {topic: all_[i][1] for topic, all_ in by_topic.items()}
            assert of["/camera/record"] == frame.record
            image, depth = of["/camera/image"], of["/camera/depth"]
            assert image.format == "png" and image.frame_id == depth.frame_id == "camera"
            assert (np.asarray(Image.open(io.BytesIO(image.data))) == frame.image).all()
            assert (depth.encoding, depth.step, depth.width, depth.height) == ("32FC1", 512, 128, 72)
            assert np.frombuffer(depth.data, "<f4").tobytes() == frame.channels["depth.Z"].tobytes()
            inner = frame.record["sensor"]["intrinsics"]
            calibration = of["/camera/calibration"]
            assert list(calibration.K) == [inner["fx_px"], 0, inner["cx_px"], 0, inner["fy_px"], inner["cy_px"], 0, 0, 1]
            pose = np.array(frame.record["camera"]["world_from_camera"])
            place = of["/tf"].translation
            assert np.allclose([place.x, place.y, place.z], pose[:3, 3], atol=1e-6)
            update = of["/camera/objects"]
            assert update.deletions[0].type == 1 and len(update.entities) == len(frame.objects)
            for entity, thing in zip(update.entities, frame.objects):
                size, centre = entity.cubes[0].size, entity.cubes[0].pose.position
                assert [size.x, size.y, size.z] == thing["box_3d"]["size_m"]
                assert [centre.x, centre.y, centre.z] == thing["box_3d"]["world"]["centre_m"]
                assert {p.key: p.value for p in entity.metadata}["name"] == thing["name"]


def test_schemas_in_the_file_are_foxgloves(export):
    file = sorted(export("mcap").glob("*.mcap"))[0]
    with file.open("rb") as stream:
        schemas = make_reader(stream).get_summary().schemas.values()
        data = [schema.data for schema in schemas if schema.encoding == "protobuf"]
    assert len(data) == 5
    described = {m.name: m for f in FileDescriptorSet.FromString(data[0]).file for m in f.message_type if f.package == "foxglove"}
    assert len(described) == 21
    for name, message in described.items():
        real = importlib.import_module(f"foxglove_schemas_protobuf.{name}_pb2").DESCRIPTOR.message_types_by_name[name]
        fields = lambda m: {(f.name, f.number, f.type, f.label) for f in m.field}
        proto = type(message)()
        real.CopyToProto(proto)
        assert fields(message) == fields(proto), name
        kinds = lambda m: {f.name: f.type_name for f in m.field if f.type_name}
        assert kinds(message) == kinds(proto), name
