"""Exports as the readers of their own ecosystems see them, and checked by numbers against the data set."""

import contextlib
import csv
import io
import json
import math

import numpy as np
import pykitti
import pytest
from cityscapesscripts.evaluation.instances2dict import instances2dict
from cityscapesscripts.helpers.annotation import Annotation
from cityscapesscripts.helpers.labels import id2label
from cityscapesscripts.preparation.json2labelImg import createLabelImage
from conftest import run
from fogbank_tools.dataset import plan, read_frame
from PIL import Image
from pycocotools.coco import COCO


@pytest.fixture(scope="module")
def frames(street):
    return [read_frame(street, line["id"]) for line in plan(street)]


def export(data_set, fmt, to, *more):
    told = run("export", data_set, "--format", fmt, "--out", to, *more)
    assert told.returncode == 0, told.stderr
    return to


def visible(frame, classes=None):
    """Things of which a pixel is visible, by instance."""
    return {o["instance"]: o for o in frame.objects if o["visible_pixels"] and (not classes or o["class"] in classes)}


def encloses(corners_px, mask, slack=0.05):
    rows, columns = np.nonzero(mask)
    low, high = corners_px.min(axis=0) - slack, corners_px.max(axis=0) + slack
    return low[0] <= columns.min() and low[1] <= rows.min() and high[0] >= columns.max() and high[1] >= rows.max()


def test_coco(street, frames, tmp_path):
    out = export(street, "coco", tmp_path / "coco")
    with contextlib.redirect_stdout(io.StringIO()):
        coco = COCO(str(out / "annotations/instances.json"))
    assert [i["file_name"] for i in coco.imgs.values()] == [f"{f.id}.png" for f in frames]
    assert {c["name"] for c in coco.cats.values()} >= {"car", "person", "building"}
    for image, frame in zip(coco.imgs.values(), frames):
        assert Image.open(out / "images" / image["file_name"]).size == (image["width"], image["height"]) == (160, 90)
        assert image["fogbank"]["fog_at_camera"]["sigma_t_1_m"] == 0.03
        things = visible(frame)
        annotations = coco.loadAnns(coco.getAnnIds(imgIds=image["id"]))
        assert sorted(a["instance"] for a in annotations) == sorted(things)
        for a in annotations:
            mask, thing = coco.annToMask(a), things[a["instance"]]
            assert (mask == (frame.instance == a["instance"])).all() and mask.sum() == a["area"]
            rows, columns = np.nonzero(mask)
            assert a["bbox"] == [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1]
            assert a["category_id"] == thing["class_id"] and not a["iscrowd"]
            for key in ("detectable", "transmittance", "distance_m", "hidden_by"):
                assert a[key] == thing[key]


def test_coco_keypoints(approach, tmp_path):
    out = export(approach, "coco", tmp_path / "coco")
    with contextlib.redirect_stdout(io.StringIO()):
        coco = COCO(str(out / "annotations/instances.json"))
    (category,) = coco.loadCats(coco.getCatIds(catNms=["runway"]))
    assert "threshold_left" in category["keypoints"]
    frame = read_frame(approach, plan(approach)[0]["id"])
    (thing,) = [o for o in frame.objects if o["class"] == "runway"]
    (a,) = coco.loadAnns(coco.getAnnIds(imgIds=1, catIds=[category["id"]]))
    triples = np.reshape(a["keypoints"], (-1, 3))
    assert len(triples) == len(category["keypoints"]) and a["num_keypoints"] == (triples[:, 2] > 0).sum() > 3
    points = {k["name"]: k for k in thing["keypoints"]}
    for name, (x, y, v) in zip(category["keypoints"], triples):
        if v:
            # COCO counts from the centre of the first pixel.
            assert np.allclose([x + 0.5, y + 0.5], points[name]["image_px"], atol=1e-9)
            assert (v == 2) == points[name]["visible"]


KITTI = {"car": "Car", "truck": "Truck", "person": "Pedestrian"}


def kitti_corners(words):
    """The corners of a label's box in camera axes, as KITTI's development kit computes them."""
    height, width, length, x, y, z, ry = map(float, words[8:15])
    turn = np.array([[math.cos(ry), 0, math.sin(ry)], [0, 1, 0], [-math.sin(ry), 0, math.cos(ry)]])
    box = [[i * length / 2, j * -height, k * width / 2] for i in (-1, 1) for j in (0, 1) for k in (-1, 1)]
    return np.array(box) @ turn.T + [x, y, z]


def test_kitti(street, frames, tmp_path):
    out = export(street, "kitti", tmp_path / "kitti")
    checked = 0
    for n, frame in enumerate(frames[::2]):
        calib = dict(line.split(":") for line in (out / f"training/calib/{n:06}.txt").read_text().splitlines())
        p2, p3 = (np.array(calib[p].split(), float).reshape(3, 4) for p in ("P2", "P3"))
        assert math.isclose((p2[0, 3] - p3[0, 3]) / p2[0, 0], 0.5)
        lines = (out / f"training/label_2/{n:06}.txt").read_text().splitlines()
        more = json.loads((out / f"training/meta_2/{n:06}.json").read_text())
        things = visible(frame, KITTI)
        assert sorted(m["instance"] for m in more["labels"]) == sorted(things) and more["frame"]["id"] == frame.id
        for line, side in zip(lines, more["labels"]):
            words, thing = line.split(), things[side["instance"]]
            mask = frame.instance == thing["instance"]
            assert len(words) == 15 and words[0] == KITTI[thing["class"]]
            assert math.isclose(float(words[1]), thing["truncation"], abs_tol=1e-4)
            # Ahead of the observer alpha is rotation_y, less the direction in which the thing is seen.
            x, z, ry, alpha = (float(words[i]) for i in (11, 13, 14, 3))
            assert abs((ry - math.atan2(x, z) - alpha + math.pi) % (2 * math.pi) - math.pi) < 3e-4
            corners = kitti_corners(words)
            left, top, right, bottom = map(float, words[4:8])
            assert encloses(np.array([[left, top], [right, bottom]]), mask, 0.5)
            if corners[:, 2].min() > 0.1:
                px = np.c_[corners, np.ones(8)] @ p2.T
                assert encloses(px[:, :2] / px[:, 2:], mask), line
                # Its nearest pixel is in the box's depths.
                depth = frame.channels["depth.Z"][mask].min()
                assert corners[:, 2].min() - 0.01 < depth < corners[:, 2].max() + 0.01
                checked += 1
        depth = np.array(Image.open(out / f"training/depth_2/{n:06}.png"))
        truth = frame.channels["depth.Z"]
        assert depth.dtype == np.uint16
        near = truth < 255
        assert np.abs(depth[near] / 256 - truth[near]).max() <= 1 / 512 and not depth[~np.isfinite(truth)].any()
    assert checked > 20


def test_kitti_odometry(street, frames, tmp_path):
    out = export(street, "kitti", tmp_path / "kitti")
    odometry = pykitti.odometry(str(out / "odometry"), "00")
    assert len(odometry) == 2 and odometry.timestamps[1].total_seconds() == 0.1
    assert math.isclose(odometry.calib.b_rgb, 0.5)
    first, second = (np.array(f.record["camera"]["world_from_camera"]) for f in frames[::2])
    assert np.allclose(odometry.poses[1], np.linalg.inv(first) @ second, atol=1e-6)
    for i, (left, right) in enumerate(odometry.rgb):
        for picture, frame in zip((left, right), frames[2 * i :]):
            assert (np.array(picture) == np.array(Image.open(street / f"{frame.id}.rgb.png"))).all()


def test_cityscapes(street, frames, tmp_path):
    out = export(street, "cityscapes", tmp_path / "cs")
    for n, frame in enumerate(frames[::2]):
        core = f"street_000000_{n:06}"
        base = str(out / f"gtFine/train/street/{core}_gtFine_")
        labels, ids, colour = (
            np.array(Image.open(f"{base}{kind}.png")) for kind in ("labelIds", "instanceIds", "color")
        )
        # Cityscapes' own classes are as they were; plates are their cars', ours have a stand-in.
        same = frame.semantic <= 33
        assert labels.dtype == np.uint8 and (labels[same] == frame.semantic[same]).all() and labels.max() <= 33
        assert set(np.unique(labels[frame.semantic == 34])) <= {0, *range(26, 34)}
        assert (colour == np.array([(*id2label[i].color, 255) for i in range(34)], np.uint8)[labels]).all()
        assert ((ids < 1000) == ~np.isin(labels, range(24, 34))).all()
        assert (np.where(ids < 1000, ids, ids // 1000) == labels).all()
        for value in np.unique(ids[ids >= 1000]):
            assert len(np.unique(frame.instance[(ids == value) & (frame.semantic != 34)])) == 1
        (found,) = instances2dict(f"{base}instanceIds.png").values()
        movers = visible(frame, ["car", "person", "truck"])
        for name in ("car", "person"):
            assert len(found[name]) == sum(o["class"] == name for o in movers.values()) > 3
        annotation = Annotation()
        annotation.fromJsonFile(f"{base}polygons.json")
        assert (np.array(createLabelImage(annotation, "ids")) == labels).mean() > 0.995
        disparity = np.array(Image.open(out / f"disparity/train/street/{core}_disparity.png"))
        camera = json.loads((out / f"camera/train/street/{core}_camera.json").read_text())
        depth = frame.channels["depth.Z"]
        want = camera["intrinsic"]["fx"] * camera["extrinsic"]["baseline"] / depth
        assert np.abs((disparity - 1) / 256 - want).max() <= 1 / 512 + 1e-6
        for side, other in (("left", frame), ("right", frames[2 * n + 1])):
            picture = out / f"{side}Img8bit/train/street/{core}_{side}Img8bit.png"
            assert picture.read_bytes() == (street / f"{other.id}.rgb.png").read_bytes()


V1 = """image height width type original_dataset scenario airport runway time_to_landing weather night time slant_distance
along_track_distance height_above_runway lateral_path_angle vertical_path_angle yaw pitch roll watermark_height
x_A y_A x_B y_B x_C y_C x_D y_D""".split()
V2 = """uuid image height width type original_dataset scenario airport runway time_to_landing weather night time lat_cam lon_cam
alt_cam yaw pitch roll slant_distance along_track_distance height_above_runway lateral_path_angle vertical_path_angle
watermark_height runway_in_cone x_TR y_TR x_TL y_TL x_BL y_BL x_BR y_BR""".split()


@pytest.mark.parametrize("edition, columns", [("lard-v1", V1), ("lard-v2", V2)])
def test_lard(approach, tmp_path, edition, columns):
    """The columns of LARD's `labels.py`, its sign and its units; its loader wants a file with the folder's name."""
    out = export(approach, edition, tmp_path / "lard")
    with open(out / "lard.csv", newline="") as file:
        reader = csv.DictReader(file, delimiter=";")
        assert reader.fieldnames[: len(columns)] == columns
        rows = list(reader)
    ids = [line["id"] for line in plan(approach)]
    assert [row["fogbank_frame"] for row in rows] == ids[:3]
    for row in rows:
        frame = read_frame(approach, row["fogbank_frame"])
        where = frame.record["aviation"]["position"]
        assert Image.open(out / row["image"]).size == (int(row["width"]), int(row["height"]))
        number = {key: float(value) for key, value in row.items() if key[:2] in ("x_", "y_") or "_" in key and value
                  and key.split("_")[-1] in ("distance", "runway", "angle")}
        along, cross, height = (where[k] for k in ("along_track_m", "cross_track_m", "height_above_threshold_m"))
        assert math.isclose(number["slant_distance"] * 1852, where["slant_range_to_threshold_m"], rel_tol=1e-4)
        assert math.isclose(number["along_track_distance"] * 1852, along, rel_tol=1e-4)
        assert math.isclose(number["height_above_runway"] * 0.3048, height, rel_tol=1e-3)
        reference = 3050 if edition == "lard-v1" else 0
        lateral = math.degrees(math.atan2(cross, along + reference))
        assert cross > 0 and math.isclose(number["lateral_path_angle"], lateral, rel_tol=1e-3)
        assert math.isclose(number["vertical_path_angle"], math.degrees(math.atan2(height, along + 305)), rel_tol=2e-3)
        assert (row["runway"], row["weather"], row["night"], row["pitch"]) == ("36", "fog", "False", "87.000000")
        (thing,) = [o for o in frame.objects if o["class"] == "runway"]
        corners = {k["name"]: k["image_px"] for k in thing["keypoints"]}
        names = {"TR": "end_right", "TL": "end_left", "BL": "threshold_left", "BR": "threshold_right"}
        if edition == "lard-v2":
            found = {names[c]: [number[f"x_{c}"], number[f"y_{c}"]] for c in names}
            assert all(np.allclose(found[name], corners[name]) for name in found)
        else:
            found = [(number[f"x_{c}"], number[f"y_{c}"]) for c in "ABCD"]
            assert sorted(map(tuple, (corners[n] for n in names.values()))) == sorted(found)
            assert found == sorted(found, key=lambda p: p[1] * 160 + p[0])


def test_nuscenes(street, frames, tmp_path):
    devkit = pytest.importorskip("nuscenes.nuscenes", reason="nuscenes-devkit is not installed (tools/test.sh does)")
    from nuscenes.utils.geometry_utils import view_points

    out = export(street, "nuscenes", tmp_path / "nuscenes")
    nusc = devkit.NuScenes("v1.0-fogbank", str(out), verbose=False)
    (scene,) = nusc.scene
    assert scene["nbr_samples"] == 2 and "MOR" in scene["description"] and len(nusc.calibrated_sensor) == 2
    sample = nusc.get("sample", scene["first_sample_token"])
    following = nusc.get("sample", sample["next"])
    assert (following["prev"], following["next"], following["timestamp"]) == (sample["token"], "", 100_000)
    by_id, checked = {f.id: f for f in frames}, 0
    for sample in (sample, following):
        assert set(sample["data"]) == {"CAM_LEFT", "CAM_RIGHT"}
        for channel, token in sample["data"].items():
            path, boxes, intrinsic = nusc.get_sample_data(token)
            frame = by_id[nusc.get("sample_data", token)["fogbank"]["id"]]
            assert Image.open(path).size == (160, 90)
            for box in boxes:
                view = nusc.get("sample_annotation", box.token)["fogbank"].get(channel)
                if view and box.corners()[2].min() > 0.1:
                    corners = view_points(box.corners(), intrinsic, normalize=True)[:2].T
                    assert encloses(corners, frame.instance == view["instance"]), box
                    checked += 1
    assert checked > 40
    # Cars of the street drive along it: their boxes' x is north, or south, as the world's box says.
    thing = next(o for o in visible(frames[0], ["car"]).values())
    annotation = next(a for a in nusc.sample_annotation if a["fogbank"].get("CAM_LEFT", {}).get("name") == thing["name"])
    x, y, z = thing["box_3d"]["world"]["centre_m"]
    assert np.allclose(annotation["translation"], [x, -z, y])
    width, height, length = thing["box_3d"]["size_m"]
    assert annotation["size"] == [width, length, height]
    w, i, j, k = annotation["rotation"]
    forward = [1 - 2 * (j * j + k * k), 2 * (i * j + k * w)]
    heading = math.radians(thing["box_3d"]["world"]["heading_deg"])
    assert np.allclose(forward, [math.sin(heading), math.cos(heading)], atol=1e-5)
    for instance in nusc.instance:
        tokens, token = [], instance["first_annotation_token"]
        while token:
            tokens.append(token)
            token = nusc.get("sample_annotation", token)["next"]
        assert len(tokens) == instance["nbr_annotations"] and tokens[-1] == instance["last_annotation_token"]
