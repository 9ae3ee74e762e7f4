//! The C functions of Open Image Denoise that are used, behind safe ones. Nothing else in this crate is unsafe.
//!
//! Signatures and constants are those of the header `oidn.h` of version 2 (RenderKit/oidn).
#![allow(unsafe_code)] // Foreign functions cannot be called otherwise; each block says why it is sound.

use crate::Error;
use libloading::Library;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;

type Handle = *mut c_void;

/// `OIDN_DEVICE_TYPE_CPU`.
const CPU: c_int = 1;
/// `OIDN_FORMAT_FLOAT3`.
const FLOAT3: c_int = 3;

/// The loaded functions.
#[derive(Debug)]
pub(crate) struct Api {
    new_device: unsafe extern "C" fn(c_int) -> Handle,
    set_device_int: unsafe extern "C" fn(Handle, *const c_char, c_int),
    set_device_bool: unsafe extern "C" fn(Handle, *const c_char, bool),
    get_device_int: unsafe extern "C" fn(Handle, *const c_char) -> c_int,
    get_device_error: unsafe extern "C" fn(Handle, *mut *const c_char) -> c_int,
    commit_device: unsafe extern "C" fn(Handle),
    release_device: unsafe extern "C" fn(Handle),
    new_filter: unsafe extern "C" fn(Handle, *const c_char) -> Handle,
    #[rustfmt::skip]
    set_shared_filter_image:
        unsafe extern "C" fn(Handle, *const c_char, *mut c_void, c_int, usize, usize, usize, usize, usize),
    set_filter_bool: unsafe extern "C" fn(Handle, *const c_char, bool),
    commit_filter: unsafe extern "C" fn(Handle),
    execute_filter: unsafe extern "C" fn(Handle),
    release_filter: unsafe extern "C" fn(Handle),
    /// Keeps the functions in memory.
    _library: Library,
}

impl Api {
    pub(crate) fn load(file: &Path) -> Result<Self, Error> {
        let not_found =
            |e: libloading::Error| Error::NotFound { file: file.to_owned(), reason: e.to_string() };
        // SAFETY: loading runs the library's initialisers, which the user asked for by naming it; those of Open Image
        // Denoise have no preconditions.
        let library = unsafe { Library::new(file) }.map_err(not_found)?;
        macro_rules! function {
            ($name:literal) => {{
                // SAFETY: the field's type is the function's signature in the header of version 2, and the library
                // lives as long as the pointer, in the same struct.
                let symbol = unsafe { library.get($name) }.map_err(|_| Error::NotOidn {
                    file: file.to_owned(),
                    reason: format!("it has no function {}", $name.escape_ascii()),
                })?;
                *symbol
            }};
        }
        Ok(Self {
            new_device: function!(b"oidnNewDevice"),
            set_device_int: function!(b"oidnSetDeviceInt"),
            set_device_bool: function!(b"oidnSetDeviceBool"),
            get_device_int: function!(b"oidnGetDeviceInt"),
            get_device_error: function!(b"oidnGetDeviceError"),
            commit_device: function!(b"oidnCommitDevice"),
            release_device: function!(b"oidnReleaseDevice"),
            new_filter: function!(b"oidnNewFilter"),
            set_shared_filter_image: function!(b"oidnSetSharedFilterImage"),
            set_filter_bool: function!(b"oidnSetFilterBool"),
            commit_filter: function!(b"oidnCommitFilter"),
            execute_filter: function!(b"oidnExecuteFilter"),
            release_filter: function!(b"oidnReleaseFilter"),
            _library: library,
        })
    }

    /// The processor, ready to work on so many threads.
    pub(crate) fn device(&self, threads: usize) -> Result<Device<'_>, Error> {
        // SAFETY: no preconditions; a null handle is refused here.
        let handle = unsafe { (self.new_device)(CPU) };
        if handle.is_null() {
            return Err(Error::Refused(self.message(handle)));
        }
        let device = Device { api: self, handle };
        let threads = c_int::try_from(threads.max(1)).unwrap_or(c_int::MAX);
        // SAFETY: the handle is that of a device which lives until `device` is dropped; names are C strings.
        unsafe {
            (self.set_device_int)(handle, c"numThreads".as_ptr(), threads);
            (self.set_device_bool)(handle, c"setAffinity".as_ptr(), false);
            (self.commit_device)(handle);
        }
        device.check()?;
        Ok(device)
    }

    /// The last error of a device, or of this thread if there is none, in words.
    fn message(&self, device: Handle) -> String {
        let mut text: *const c_char = std::ptr::null();
        // SAFETY: null asks for the thread's error; the out pointer is valid for the call.
        let code = unsafe { (self.get_device_error)(device, &raw mut text) };
        if text.is_null() {
            return format!("error {code}");
        }
        // SAFETY: the library returns a C string that is valid until the next call on this thread; it is copied.
        unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
    }
}

/// A device, released when dropped.
pub(crate) struct Device<'a> {
    api: &'a Api,
    handle: Handle,
}

/// One run of the filter for path-traced pictures.
pub(crate) struct Filter<'a> {
    /// Columns and rows of every image.
    pub(crate) size: [usize; 2],
    /// Images by name, each of columns × rows pixels.
    pub(crate) inputs: &'a [(&'a CStr, &'a [[f32; 3]])],
    /// Names of what is switched on.
    pub(crate) switches: &'a [&'a CStr],
}

impl Device<'_> {
    /// Major, minor and patch number of the library.
    pub(crate) fn version(&self) -> [u32; 3] {
        // SAFETY: a live device and a C string.
        let number = unsafe { (self.api.get_device_int)(self.handle, c"version".as_ptr()) };
        let number = u32::try_from(number).unwrap_or(0);
        [number / 10_000, number / 100 % 100, number % 100]
    }

    /// Runs the filter.
    pub(crate) fn execute(&self, filter: Filter<'_>, output: &mut [[f32; 3]]) -> Result<(), Error> {
        let Filter { size: [width, height], inputs, switches } = filter;
        let fits = |image: &[[f32; 3]]| Some(image.len()) == width.checked_mul(height);
        assert!(fits(output) && inputs.iter().all(|(_, image)| fits(image)), "images of {width} × {height}");
        let api = self.api;
        // SAFETY: a live device and a C string; a null handle is refused.
        let handle = unsafe { (api.new_filter)(self.handle, c"RT".as_ptr()) };
        if handle.is_null() {
            return Err(Error::Refused(api.message(self.handle)));
        }
        // SAFETY: the images have width × height triples of f32 without gaps, as was just checked, and outlive the filter,
        // which is released below. Inputs are only read, though the function takes no const pointer. Executing returns when
        // all is written.
        unsafe {
            let share = |name: &CStr, image: *mut c_void| {
                (api.set_shared_filter_image)(handle, name.as_ptr(), image, FLOAT3, width, height, 0, 0, 0);
            };
            for (name, image) in inputs {
                share(name, image.as_ptr().cast_mut().cast());
            }
            share(c"output", output.as_mut_ptr().cast());
            for name in switches {
                (api.set_filter_bool)(handle, name.as_ptr(), true);
            }
            (api.commit_filter)(handle);
            (api.execute_filter)(handle);
            (api.release_filter)(handle);
        }
        self.check()
    }

    fn check(&self) -> Result<(), Error> {
        let mut text: *const c_char = std::ptr::null();
        // SAFETY: a live device; the out pointer is valid for the call.
        let code = unsafe { (self.api.get_device_error)(self.handle, &raw mut text) };
        if code == 0 {
            return Ok(());
        }
        let message = match text.is_null() {
            true => format!("error {code}"),
            // SAFETY: as in `Api::message`.
            false => unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned(),
        };
        Err(Error::Refused(message))
    }
}

impl Drop for Device<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is released once, and nothing uses it afterwards.
        unsafe { (self.api.release_device)(self.handle) }
    }
}
