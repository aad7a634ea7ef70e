//! A thread that does one kind of work, the newest request first.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tam_gen::Job;

/// Called by threads when there is something to show.
pub(crate) type Wake = Arc<dyn Fn() + Send + Sync>;

/// A worker: of the requests made while it works only the newest is kept, and what it works on is cancelled, unless it
/// began so recently that it is better finished: a slider that never rests would never show anything. What is queued
/// waits until there is nothing newer to do.
pub(crate) struct Worker<Request, Reply> {
    shared: Arc<Shared<Request>>,
    patience: Duration,
    replies: Receiver<Reply>,
    thread: JoinHandle<()>,
}

/// How long a worker that is dropped is waited for: drivers break down where a process ends while a thread draws.
const LEAVE: Duration = Duration::from_secs(2);

struct Shared<Request> {
    inbox: Mutex<Inbox<Request>>,
    filled: Condvar,
    /// Part done, in thousandths.
    done: AtomicU32,
}

struct Inbox<Request> {
    newest: Option<Request>,
    queue: VecDeque<Request>,
    /// Of what is being worked on: stops it, and when it began.
    working: Option<(Arc<AtomicBool>, Instant)>,
    closed: bool,
}

impl<Request> Shared<Request> {
    fn lock(&self) -> MutexGuard<'_, Inbox<Request>> {
        self.inbox.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Request: Send + 'static, Reply: Send + 'static> Worker<Request, Reply> {
    /// Starts the thread; work younger than `patience` is finished when there is a newer request. `work` makes replies of requests, any number of them; `failed` makes one of a request whose work
    /// panicked.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub(crate) fn start<State: 'static>(
        name: &str,
        patience: Duration,
        wake: Wake,
        state: impl FnOnce() -> State + Send + 'static,
        work: impl Fn(&mut State, Request, &Job<'_>, &dyn Fn(Reply)) + Send + 'static,
        failed: impl Fn(String) -> Reply + Send + 'static,
    ) -> std::io::Result<Self> {
        let inbox = Inbox { newest: None, queue: VecDeque::new(), working: None, closed: false };
        let shared = Arc::new(Shared { inbox: Mutex::new(inbox), filled: Condvar::new(), done: AtomicU32::new(0) });
        let (sender, replies) = channel();
        let of_thread = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            let mut state = state();
            while let Some((request, cancel)) = of_thread.next() {
                let reply = |reply: Reply| send(&sender, &wake, reply);
                let made = catch_unwind(AssertUnwindSafe(|| {
                    let progress = |part: f32| {
                        let thousandths = (part * 1000.0) as u32;
                        if of_thread.done.swap(thousandths, Ordering::Relaxed) != thousandths {
                            wake();
                        }
                    };
                    let job = Job { progress: Some(&progress), cancel: Some(&cancel), measure: None };
                    work(&mut state, request, &job, &reply);
                }));
                if let Err(panic) = made {
                    reply(failed(words_of(panic.as_ref())));
                }
                of_thread.lock().working = None;
                wake();
            }
        })?;
        Ok(Self { shared, patience, replies, thread })
    }

    /// Asks for this next; what is being worked on and what waits is dropped.
    pub(crate) fn request(&self, request: Request) {
        let mut inbox = self.shared.lock();
        inbox.newest = Some(request);
        if let Some((cancel, began)) = &inbox.working
            && began.elapsed() >= self.patience
        {
            cancel.store(true, Ordering::Relaxed);
        }
        self.shared.filled.notify_one();
    }

    /// Asks for this when there is nothing newer to do.
    pub(crate) fn queue(&self, request: Request) {
        self.shared.lock().queue.push_back(request);
        self.shared.filled.notify_one();
    }

    /// Stops what is being worked on and forgets what waits.
    pub(crate) fn cancel(&self) {
        let mut inbox = self.shared.lock();
        inbox.newest = None;
        inbox.queue.clear();
        if let Some((cancel, _)) = &inbox.working {
            cancel.store(true, Ordering::Relaxed);
        }
    }

    /// Whether there is anything left to do.
    pub(crate) fn is_busy(&self) -> bool {
        let inbox = self.shared.lock();
        inbox.working.is_some() || inbox.newest.is_some() || !inbox.queue.is_empty()
    }

    /// Part done of what is being worked on, 0..=1; `None` at rest.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.is_busy().then(|| self.shared.done.load(Ordering::Relaxed) as f32 / 1000.0)
    }

    /// What was made since the last call.
    pub(crate) fn replies(&self) -> impl Iterator<Item = Reply> + '_ {
        self.replies.try_iter()
    }
}

impl<Request> Shared<Request> {
    /// Waits for the next request; `None` when the worker is dropped.
    fn next(&self) -> Option<(Request, Arc<AtomicBool>)> {
        let mut inbox = self.lock();
        loop {
            if inbox.closed {
                return None;
            }
            let newest = inbox.newest.take();
            if let Some(request) = newest.or_else(|| inbox.queue.pop_front()) {
                let cancel = Arc::new(AtomicBool::new(false));
                inbox.working = Some((Arc::clone(&cancel), Instant::now()));
                self.done.store(0, Ordering::Relaxed);
                return Some((request, cancel));
            }
            inbox = self.filled.wait(inbox).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<Request, Reply> Drop for Worker<Request, Reply> {
    fn drop(&mut self) {
        self.close();
        let start = Instant::now();
        while !self.thread.is_finished() && start.elapsed() < LEAVE {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

impl<Request, Reply> Worker<Request, Reply> {
    fn close(&self) {
        let mut inbox = self.shared.lock();
        inbox.closed = true;
        if let Some((cancel, _)) = &inbox.working {
            cancel.store(true, Ordering::Relaxed);
        }
        self.shared.filled.notify_one();
    }
}

fn send<Reply>(sender: &Sender<Reply>, wake: &Wake, reply: Reply) {
    // Nobody listens any more once the window is closed.
    if sender.send(reply).is_ok() {
        wake();
    }
}

fn words_of(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason is known".to_owned())
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn quiet() -> Wake {
        Arc::new(|| ())
    }

    fn wait_until(condition: impl Fn() -> bool) {
        let start = Instant::now();
        while !condition() {
            assert!(start.elapsed() < Duration::from_secs(20), "it never came to pass");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn the_newest_request_wins_and_older_ones_are_cancelled() {
        let worker: Worker<u32, u32> = Worker::start(
            "test",
            Duration::ZERO,
            quiet(),
            || (),
            |(), request, job, reply| {
                while request == 0 && !job.cancelled() {
                    std::thread::yield_now();
                }
                reply(request);
            },
            |_| u32::MAX,
        )
        .expect("a thread");
        worker.request(0);
        wait_until(|| worker.shared.lock().working.is_some());
        (1..=50).for_each(|request| worker.request(request));
        wait_until(|| !worker.is_busy());
        let replies: Vec<u32> = worker.replies().collect();
        assert_eq!((replies[0], replies[replies.len() - 1]), (0, 50));
        assert!(replies.len() < 51, "requests in between are dropped: {replies:?}");
    }

    #[test]
    fn a_panic_becomes_a_reply_and_the_thread_goes_on() {
        let worker: Worker<bool, Result<(), String>> = Worker::start(
            "test",
            Duration::ZERO,
            quiet(),
            || (),
            |(), fails: bool, _, reply| {
                assert!(!fails, "as asked for");
                reply(Ok(()));
            },
            Err,
        )
        .expect("a thread");
        worker.queue(true);
        worker.queue(false);
        wait_until(|| !worker.is_busy());
        let replies: Vec<_> = worker.replies().collect();
        assert!(replies[0].as_ref().is_err_and(|words| words.contains("as asked for")), "{replies:?}");
        assert_eq!(replies[1], Ok(()));
    }

    #[test]
    fn a_worker_that_is_dropped_has_left_off() {
        let done = Arc::new(AtomicBool::new(false));
        let of_thread = Arc::clone(&done);
        let work = move |(): &mut (), (), job: &Job<'_>, _: &dyn Fn(())| {
            while !job.cancelled() {
                std::thread::yield_now();
            }
            std::thread::sleep(Duration::from_millis(30));
            of_thread.store(true, Ordering::Relaxed);
        };
        let worker: Worker<(), ()> =
            Worker::start("test", Duration::ZERO, quiet(), || (), work, |_| ()).expect("a thread");
        worker.request(());
        wait_until(|| worker.shared.lock().working.is_some());
        drop(worker);
        assert!(done.load(Ordering::Relaxed));
    }

    #[test]
    fn progress_is_that_of_the_work_at_hand() {
        let worker: Worker<(), ()> = Worker::start(
            "test",
            Duration::ZERO,
            quiet(),
            || (),
            |(), (), job, _| {
                job.report(0.5);
                while !job.cancelled() {
                    std::thread::yield_now();
                }
            },
            |_| (),
        )
        .expect("a thread");
        assert_eq!(worker.progress(), None);
        worker.request(());
        wait_until(|| worker.progress() == Some(0.5));
        worker.cancel();
        wait_until(|| worker.progress().is_none());
    }
}
