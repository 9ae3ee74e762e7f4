//! A frame's camera, from its record.

use fog_core::{DMat4, DQuat, DVec3};
use serde_json::Value;

use crate::frame::Frame;
use crate::{Error, Result};

/// How a camera forms its image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lens {
    Pinhole,
    /// OpenCV's radial and tangential distortion.
    Distorted,
    /// A fisheye or a panorama: no matrix projects its points.
    Other(&'static str),
}

/// A frame's camera: x right, y down, z forward.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Camera {
    /// Camera to world; world +Y is up.
    pub(crate) world_from_camera: DMat4,
    /// fx, fy, cx, cy in pixels, the centre of the top left pixel at (0, 0); zeros for a panorama.
    pub(crate) intrinsics: [f64; 4],
    pub(crate) lens: Lens,
}

impl Camera {
    /// Reads it.
    ///
    /// # Errors
    /// [`Error::Damaged`] when the record has none; [`Error::DataSet`] when it cannot be read.
    pub(crate) fn of(frame: &Frame<'_>) -> Result<Self> {
        let record = frame.record()?;
        let matrix = matrix(&record["camera"]["world_from_camera"]);
        let world_from_camera =
            matrix.ok_or_else(|| frame.damaged("json", "it has no camera.world_from_camera"))?;
        let inner = &record["sensor"]["intrinsics"];
        let lens = match (inner["distortion"]["model"].as_str(), inner["model"].as_str()) {
            (None, None) => Lens::Pinhole,
            (Some("opencv"), _) => Lens::Distorted,
            (Some(_), _) => Lens::Other("a fisheye"),
            (None, Some(_)) => Lens::Other("equirectangular"),
        };
        let number = |key: &str| inner[key].as_f64().unwrap_or_default();
        Ok(Self { world_from_camera, intrinsics: ["fx_px", "fy_px", "cx_px", "cy_px"].map(number), lens })
    }

    /// The same, of a frame whose format knows pinhole cameras only: fisheyes and panoramas are refused, distortion is counted.
    pub(crate) fn pinhole_of(frame: &Frame<'_>, job: &crate::job::Job<'_>) -> Result<Self> {
        let camera = Self::of(frame)?;
        match camera.lens {
            Lens::Pinhole => {}
            Lens::Distorted => job.losses.add(
                "distorted_frames",
                1,
                "frames of a lens with distortion, which the calibration leaves out",
            ),
            Lens::Other(name) => {
                let reason = format!("its lens is {name}, and the format has pinhole cameras only");
                let (format, frame) = (job.format.name(), frame.id().to_owned());
                return Err(Error::Unfit { format, frame, reason });
            }
        }
        Ok(camera)
    }

    /// Position in the world, m.
    pub(crate) fn position(&self) -> DVec3 {
        self.world_from_camera.w_axis.truncate()
    }
}

/// Four rows of four numbers.
pub(crate) fn matrix(rows: &Value) -> Option<DMat4> {
    let mut all = [0.0; 16];
    for (i, value) in all.iter_mut().enumerate() {
        *value = rows[i / 4][i % 4].as_f64()?;
    }
    Some(DMat4::from_cols_array(&all).transpose())
}

/// Three numbers.
pub(crate) fn vector(value: &Value) -> Option<DVec3> {
    Some(DVec3::new(value[0].as_f64()?, value[1].as_f64()?, value[2].as_f64()?))
}

/// The oriented box of a thing, in one system of axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box3 {
    /// To the right, up and back of a thing that looks along its −Z, m.
    pub(crate) size: DVec3,
    pub(crate) centre: DVec3,
    /// Turns the thing's axes into those of the system.
    pub(crate) turn: DQuat,
}

impl Box3 {
    /// `box_3d` of a thing in the axes of its `camera` or the `world`; `None` if it is not there.
    pub(crate) fn of(object: &Value, system: &str) -> Option<Self> {
        let place = &object["box_3d"][system];
        let q = &place["quaternion_wxyz"];
        let part = |i: usize| q[i].as_f64();
        Some(Self {
            size: vector(&object["box_3d"]["size_m"])?,
            centre: vector(&place["centre_m"])?,
            turn: DQuat::from_xyzw(part(1)?, part(2)?, part(3)?, part(0)?).normalize(),
        })
    }

    /// Where the thing looks.
    pub(crate) fn forward(&self) -> DVec3 {
        self.turn * DVec3::NEG_Z
    }

    /// Middle of the lower face.
    pub(crate) fn bottom(&self) -> DVec3 {
        self.centre - self.turn * DVec3::Y * (0.5 * self.size.y)
    }
}
