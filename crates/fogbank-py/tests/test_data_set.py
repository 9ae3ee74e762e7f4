"""Data sets: frames, arrays without copies, conditions, tables, pickles, PyTorch."""

from __future__ import annotations

import gc
import json
import pickle
import shutil
import threading

import fogbank
import numpy as np
import pytest


def test_frames_in_the_order_of_the_plan(data):
    assert len(data) == 6 == len(list(data))
    assert data.counts == {"done": 6, "failed": 0, "missing": 0}
    assert data[-1].id == data.ids[-1] == data[data.ids[5]].id
    assert data[1:3].ids == data.ids[1:3]
    assert data.name == "small" and data[0] in data and data.ids[1] in data
    assert data[2].axes == {"fog.height_m": 180, "camera.altitude_m": 2}
    assert fogbank.plan(data.config).ids == data.ids
    with pytest.raises(IndexError, match="no frame 6; there are 6"):
        data[6]
    with pytest.raises(KeyError, match="none of the 6 frames"):
        data["nobody"]


def test_shapes_and_types(data):
    frame = data[0]
    want = {
        "image": ((9, 16, 3), np.uint8),
        "hdr": ((9, 16, 3), np.float32),
        "transmittance": ((9, 16, 3), np.float32),
        "depth": ((9, 16), np.float32),
        "tau": ((9, 16), np.float32),
        "semantic": ((9, 16), np.uint8),
        "instance": ((9, 16), np.uint16),
    }
    for name, (shape, dtype) in want.items():
        assert frame[name].shape == shape and frame[name].dtype == dtype, name
    assert set(frame) == set(fogbank.plan(data.config)[0]["outputs"])
    np.testing.assert_allclose(frame.direct + frame.airlight, frame.hdr, rtol=1e-6)
    np.testing.assert_allclose(frame.transmittance[..., 1], np.exp(-frame.tau), rtol=1e-5)
    with pytest.raises(AttributeError, match="no output 'flow'; it has image"):
        frame.flow
    with pytest.raises(KeyError, match="flow"):
        frame["flow"]
    assert not hasattr(frame, "raw")


def test_values_are_those_of_the_files(data):
    """Against a reader that is not ours, where it is installed, and the exact depth of the layer."""
    frame = data[0]
    fog = fogbank.Fog(height_m=100)
    # A horizontal ray to the sky would be endless: of the others τ is the integral of σ over altitude, divided by the slope.
    z = np.linspace(2, 100, 20001)
    sigma = fog.sigma_t(z)
    up = float(np.sum((sigma[1:] + sigma[:-1]) / 2 * np.diff(z)))
    rows = (np.arange(9) + 0.5 - 4.5)[:, None]
    columns = (np.arange(16) + 0.5 - 8)[None, :]
    focal = 8 / np.tan(np.radians(30))
    slope = -rows / np.sqrt(rows**2 + columns**2 + focal**2)
    above = (slope > 0.01) & np.isinf(frame.depth)
    assert above.sum() > 40
    np.testing.assert_allclose(frame.tau[above], up / slope[above], rtol=3e-4)


def test_png_files_are_what_pillow_reads(data):
    image = pytest.importorskip("PIL.Image")
    for output, suffix in (("image", "rgb"), ("instance", "instance")):
        with image.open(data.dir / f"{data.ids[0]}.{suffix}.png") as picture:
            assert np.array_equal(np.asarray(picture), data[0][output])


def test_arrays_take_over_the_buffer(data):
    frame = data[0]
    depth = frame.depth
    # The array does not own its memory: it belongs to the buffer that the decoder filled, which the array keeps alive.
    assert frame.depth is depth and not depth.flags.owndata and depth.base is not None
    assert depth.flags.c_contiguous and depth.flags.writeable and np.shares_memory(depth, frame["depth"])
    kept = depth.copy()
    del frame
    gc.collect()
    assert np.array_equal(kept, depth)


def test_conditions(data):
    assert [f.axes["fog.height_m"] for f in data.where("fog.height_m >= 180")] == [180, 180, 260, 260]
    chosen = data.where("fog.height_m >= 180").where("camera.altitude_m = 30")
    assert len(chosen) == 2 and chosen.counts["done"] == 6
    assert len(data.where("fog.height_m = 180, camera.altitude_m != 2")) == 1
    with pytest.raises(fogbank.ConfigError, match="did you mean `fog.height_m`"):
        data.where("fog.heigth_m > 1")


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_table(data, library):
    pytest.importorskip(library)
    table = data.table(library)
    assert table.shape[0] == 6 and list(table.columns)[:4] == ["id", "pair_id", "fog.height_m", "camera.altitude_m"]
    assert list(table["fog.height_m"]) == [100, 100, 180, 180, 260, 260]
    sigma = [frame.record["fog_state"]["at_camera"]["sigma_t_1_m"] for frame in data]
    assert list(table["fog_state.at_camera.sigma_t_1_m"]) == sigma
    assert list(table["camera.position_m.1"]) == [2, 30, 2, 30, 2, 30]


def test_records(data):
    frame = data[0]
    with (data.dir / f"{frame.id}.json").open() as file:
        assert frame.record == json.load(file)
    assert frame.spec["fog"]["height_m"] == 100 and frame.objects is None
    assert frame.pair_id == data[2].pair_id != data[1].pair_id


def test_pickles(data):
    copy = pickle.loads(pickle.dumps(data.where("camera.altitude_m = 2")))
    assert copy.ids == data.where("camera.altitude_m = 2").ids
    frame = pickle.loads(pickle.dumps(data[1]))
    assert np.array_equal(frame.hdr, data[1].hdr)


def test_threads_share_a_frame(data):
    frame = data[0]
    found: list[int] = []

    def read() -> None:
        found.append(id(frame.hdr) + id(frame.tau) + len(frame.record))

    threads = [threading.Thread(target=read) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and len(set(found)) == 1


def test_unfinished_frames_are_left_out_and_damage_is_an_error(data, tmp_path):
    whole = tmp_path / "copy"
    shutil.copytree(data.dir, whole)
    (whole / f"{data.ids[0]}.done").unlink()
    part = fogbank.open(whole)
    assert part.counts == {"done": 5, "failed": 0, "missing": 1} and part.ids == data.ids[1:]
    truth = whole / f"{part.ids[0]}.gt.exr"
    truth.write_bytes(truth.read_bytes()[:200])
    with pytest.raises(fogbank.DataSetError, match="gt.exr"):
        part[0].depth
    with pytest.raises(OSError, match="dataset.json"):
        fogbank.open(tmp_path)
    (whole / "dataset.json").write_text("{}")
    with pytest.raises(fogbank.FogbankError, match="dataset.json"):
        fogbank.open(whole)


def test_torch(data):
    torch = pytest.importorskip("torch")
    frames = data.torch(["hdr", "depth", "instance"], lambda item: item | {"twice": 2 * item["depth"]})
    item = frames[1]
    assert item["hdr"].shape == (3, 9, 16) and item["instance"].dtype == torch.int32 and item["id"] == data.ids[1]
    batches = list(torch.utils.data.DataLoader(data.torch(["hdr", "depth"]), batch_size=3, num_workers=2))
    assert len(batches) == 2 and batches[0]["hdr"].shape == (3, 3, 9, 16)
    assert torch.equal(batches[1]["depth"][2], torch.from_numpy(data[5].depth))
