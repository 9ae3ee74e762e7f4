//! Frames and their records to files: layout, markers, resume and verification
