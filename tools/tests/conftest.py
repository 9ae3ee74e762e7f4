"""OpenCV 4 reads OpenEXR files only if it is told so before it is imported."""

import os

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
