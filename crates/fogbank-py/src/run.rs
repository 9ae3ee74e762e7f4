//! Long work on threads of its own, while Python's thread listens: for news, and for Ctrl-C.

use crate::errors::{RenderError, exception};
use fogbank::{Error, Event, Progress};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How often Python is asked for signals while nothing else happens.
const LISTEN: Duration = Duration::from_millis(50);

/// What the work tells.
enum News {
    /// Share of the paths that are traced, in [0, 1].
    Share(f64),
    /// A line for the reader.
    Said(String),
    Warning(String),
}

/// The receiver of the library's events, on the threads of the work.
struct Listener<'a> {
    news: Mutex<Sender<News>>,
    stop: &'a AtomicBool,
    paths: AtomicU64,
    expected: AtomicU64,
}

impl Listener<'_> {
    fn tell(&self, news: News) {
        // Nobody listens any more once the work is to stop.
        let _ = self.news.lock().unwrap_or_else(PoisonError::into_inner).send(news);
    }

    fn tell_share(&self) {
        let (paths, expected) = (self.paths.load(Ordering::Relaxed), self.expected.load(Ordering::Relaxed));
        if expected > 0 {
            self.tell(News::Share((paths as f64 / expected as f64).min(1.0)));
        }
    }
}

impl Progress for Listener<'_> {
    fn event(&self, event: Event<'_>) -> bool {
        match event {
            Event::Ready { paths, .. } => self.expected.store(paths, Ordering::Relaxed),
            Event::Expected(paths) => self.expected.store(paths, Ordering::Relaxed),
            Event::Paths(n) => {
                self.paths.fetch_add(n, Ordering::Relaxed);
                self.tell_share();
            }
            Event::Warning(text) => self.tell(News::Warning(text)),
            Event::Scene { name, warnings, .. } => {
                warnings.iter().for_each(|text| self.tell(News::Warning(format!("{name}: {text}"))));
            }
            Event::FrameDone { id, seconds, .. } => {
                self.tell(News::Said(format!("frame {id} done in {seconds:.1} s")));
            }
            Event::FrameFailed { id, reason } => {
                self.tell(News::Warning(format!("frame {id} failed: {reason}")));
            }
            _ => {}
        }
        !self.stop.load(Ordering::Relaxed)
    }
}

/// Does `work` on `threads` threads (0: one for each processor) without Python's lock. `progress`, if any, is called with the share
/// of the work that is done and a text, which is mostly empty; warnings become Python's.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Progress) -> Result<T, Error> + Send,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|e| RenderError::new_err(e.to_string()))?;
    let stop = AtomicBool::new(false);
    let (sender, receiver) = channel();
    let receiver = Mutex::new(receiver);
    std::thread::scope(|scope| {
        let listener =
            Listener { news: Mutex::new(sender), stop: &stop, paths: 0.into(), expected: 0.into() };
        let worker = scope.spawn(move || pool.install(|| work(&listener)));
        let heard = listen(py, &receiver, progress.as_ref());
        stop.store(heard.is_err(), Ordering::Relaxed);
        let result = py.detach(|| worker.join());
        heard?;
        match result {
            Ok(result) => result.map_err(exception),
            // The library promises none; if there is one all the same, it is an error like others.
            Err(_) => Err(RenderError::new_err("internal error; please report it with the configuration")),
        }
    })
}

/// Passes news on until the work is over, or a signal or the receiver of the news raises an exception.
fn listen(
    py: Python<'_>,
    receiver: &Mutex<Receiver<News>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let mut share = 0.0;
    loop {
        let next = || receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(LISTEN);
        match (py.detach(next), progress) {
            (Err(RecvTimeoutError::Disconnected), _) => return Ok(()),
            // One call for each percent.
            (Ok(News::Share(now)), Some(progress)) if now >= share + 0.01 || (now == 1.0 && share < 1.0) => {
                share = now;
                progress.call1((share, ""))?;
            }
            (Ok(News::Said(text)), Some(progress)) => {
                progress.call1((share, text))?;
            }
            (Ok(News::Warning(text)), _) => {
                let text = CString::new(text.replace('\0', " ")).unwrap_or_default();
                PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 2)?;
            }
            _ => {}
        }
        py.check_signals()?;
    }
}
