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
    /// Starts another thread in place of one that was left behind; `None`: none ever is.
    restart: Option<Restart>,
    thread: Mutex<JoinHandle<()>>,
}

/// Starts the thread of a number.
type Restart = Box<dyn Fn(u64) -> std::io::Result<JoinHandle<()>> + Send + Sync>;

/// How a worker treats what it works on when there is something newer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Manner {
    /// What began no longer ago is finished; the rest is cancelled.
    pub patience: Duration,
    /// Whether what does not stop soon after it was cancelled is left behind, to end where nobody waits for it.
    pub leaves_behind: bool,
}

/// How soon what was cancelled has to stop where it can be left behind.
const SOON: Duration = Duration::from_millis(80);

/// How many threads may be left behind and not have ended: each holds what it works on.
const LEFT_BEHIND: usize = 2;

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
    working: Option<Working>,
    closed: bool,
    /// Counts threads: those before the last were left behind.
    thread: u64,
    /// Threads that were left behind and have not ended.
    left_behind: usize,
}

/// What is being worked on.
struct Working {
    cancel: Arc<AtomicBool>,
    began: Instant,
    cancelled: Option<Instant>,
}

impl Working {
    fn cancel(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
        self.cancelled.get_or_insert_with(Instant::now);
    }
}

impl<Request> Shared<Request> {
    fn lock(&self) -> MutexGuard<'_, Inbox<Request>> {
        self.inbox.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Request: Send + 'static, Reply: Send + 'static> Worker<Request, Reply> {
    /// Starts the thread. `work` makes replies of requests, any number of them; `failed` makes one of a request whose work
    /// panicked, after which it goes on with a new `state`, as nobody knows what became of the old one.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub(crate) fn start<State: 'static>(
        name: &'static str,
        manner: Manner,
        wake: Wake,
        state: impl Fn() -> State + Send + Sync + 'static,
        work: impl Fn(&mut State, Request, &Job<'_>, &dyn Fn(Reply)) + Send + Sync + 'static,
        failed: impl Fn(String) -> Reply + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let inbox =
            Inbox { newest: None, queue: VecDeque::new(), working: None, closed: false, thread: 0, left_behind: 0 };
        let shared = Arc::new(Shared { inbox: Mutex::new(inbox), filled: Condvar::new(), done: AtomicU32::new(0) });
        let (sender, replies) = channel();
        let of_threads = Arc::clone(&shared);
        let doing = Arc::new((state, work, failed));
        let spawn = move |own| {
            let (shared, wake, sender, doing) =
                (Arc::clone(&of_threads), Arc::clone(&wake), sender.clone(), Arc::clone(&doing));
            std::thread::Builder::new().name(name.to_owned()).spawn(move || {
                let (state, work, failed) = &*doing;
                let mut held = state();
                while let Some((request, cancel)) = shared.next(own) {
                    // Of what was left behind nobody wants to know.
                    let tell = |reply: Reply| {
                        if shared.lock().thread == own {
                            send(&sender, &wake, reply);
                        }
                    };
                    let made = catch_unwind(AssertUnwindSafe(|| {
                        let progress = |part: f32| {
                            let thousandths = (part * 1000.0) as u32;
                            let is_own = !cancel.load(Ordering::Relaxed);
                            if is_own && shared.done.swap(thousandths, Ordering::Relaxed) != thousandths {
                                wake();
                            }
                        };
                        let job = Job { progress: Some(&progress), cancel: Some(&cancel), measure: None };
                        work(&mut held, request, &job, &tell);
                    }));
                    if let Err(panic) = made {
                        held = state();
                        tell(failed(words_of(panic.as_ref())));
                    }
                    let mut inbox = shared.lock();
                    if inbox.thread == own {
                        inbox.working = None;
                    } else {
                        inbox.left_behind -= 1;
                    }
                    drop(inbox);
                    wake();
                }
            })
        };
        let thread = Mutex::new(spawn(0)?);
        let Manner { patience, leaves_behind } = manner;
        Ok(Self { shared, patience, replies, restart: leaves_behind.then(|| Box::new(spawn) as Restart), thread })
    }

    /// Asks for this next; what is being worked on and what waits is dropped.
    pub(crate) fn request(&self, request: Request) {
        let mut inbox = self.shared.lock();
        inbox.newest = Some(request);
        if let Some(working) = &mut inbox.working
            && working.began.elapsed() >= self.patience
        {
            working.cancel();
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
        if let Some(working) = &mut inbox.working {
            working.cancel();
        }
    }

    /// Leaves behind what was cancelled and does not stop, where that may be: another thread goes on.
    fn leave_behind(&self) {
        let Some(restart) = &self.restart else { return };
        let mut inbox = self.shared.lock();
        let cancelled = inbox.working.as_ref().and_then(|working| working.cancelled);
        if cancelled.is_none_or(|at| at.elapsed() < SOON) || inbox.left_behind >= LEFT_BEHIND {
            return;
        }
        match restart(inbox.thread + 1) {
            Ok(thread) => {
                inbox.thread += 1;
                inbox.left_behind += 1;
                inbox.working = None;
                *self.thread.lock().unwrap_or_else(PoisonError::into_inner) = thread;
            }
            Err(error) => {
                tracing::warn!("no thread is left for more work, which waits for what does not stop: {error}")
            }
        }
    }

    /// Whether there is anything left to do.
    pub(crate) fn is_busy(&self) -> bool {
        self.leave_behind();
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
    /// Waits for the next request; `None` when the worker is dropped, or this thread was left behind.
    fn next(&self, own: u64) -> Option<(Request, Arc<AtomicBool>)> {
        let mut inbox = self.lock();
        loop {
            if inbox.closed || inbox.thread != own {
                return None;
            }
            let newest = inbox.newest.take();
            if let Some(request) = newest.or_else(|| inbox.queue.pop_front()) {
                let cancel = Arc::new(AtomicBool::new(false));
                inbox.working = Some(Working { cancel: Arc::clone(&cancel), began: Instant::now(), cancelled: None });
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
        let thread = self.thread.get_mut().unwrap_or_else(PoisonError::into_inner);
        while !thread.is_finished() && start.elapsed() < LEAVE {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

impl<Request, Reply> Worker<Request, Reply> {
    fn close(&self) {
        let mut inbox = self.shared.lock();
        inbox.closed = true;
        if let Some(working) = &mut inbox.working {
            working.cancel();
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

    const STOPS: Manner = Manner { patience: Duration::ZERO, leaves_behind: false };

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
            STOPS,
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
            STOPS,
            quiet(),
            || 0,
            |half_done: &mut u32, fails: bool, _, reply| {
                assert_eq!(*half_done, 0, "what failed is not gone on with");
                *half_done += 1;
                assert!(!fails, "as asked for");
                *half_done -= 1;
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
        let worker: Worker<(), ()> = Worker::start("test", STOPS, quiet(), || (), work, |_| ()).expect("a thread");
        worker.request(());
        wait_until(|| worker.shared.lock().working.is_some());
        drop(worker);
        assert!(done.load(Ordering::Relaxed));
    }

    #[test]
    fn progress_is_that_of_the_work_at_hand() {
        let worker: Worker<(), ()> = Worker::start(
            "test",
            STOPS,
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

    #[test]
    fn what_does_not_stop_is_left_behind_and_nobody_hears_of_it() {
        // Requests below 10 wait until they are released: the third first, as another may be left behind once others end.
        let released = Arc::new([const { AtomicBool::new(false) }; 4]);
        let of_threads = Arc::clone(&released);
        let manner = Manner { leaves_behind: true, ..STOPS };
        let work = move |(): &mut (), request: u32, _: &Job<'_>, reply: &dyn Fn(u32)| {
            while of_threads.get(request as usize).is_some_and(|released| !released.load(Ordering::Relaxed)) {
                std::thread::sleep(Duration::from_millis(1));
            }
            reply(request);
        };
        let worker: Worker<u32, u32> =
            Worker::start("test", manner, quiet(), || (), work, |_| u32::MAX).expect("a thread");
        for stuck in [1, 2] {
            worker.request(stuck);
            wait_until(|| worker.shared.lock().working.is_some());
            let start = Instant::now();
            worker.request(10 + stuck);
            wait_until(|| !worker.is_busy());
            assert!(start.elapsed() >= SOON, "it is given the time to stop");
            assert_eq!(worker.replies().collect::<Vec<_>>(), [10 + stuck]);
        }
        // No more than two at a time: the third is waited for.
        worker.request(3);
        wait_until(|| worker.shared.lock().working.is_some());
        worker.request(13);
        std::thread::sleep(2 * SOON);
        assert!(worker.is_busy());
        released[3].store(true, Ordering::Relaxed);
        wait_until(|| !worker.is_busy());
        assert_eq!(worker.replies().collect::<Vec<_>>(), [3, 13]);
        released.iter().for_each(|released| released.store(true, Ordering::Relaxed));
        wait_until(|| worker.shared.lock().left_behind == 0);
        assert_eq!(worker.replies().next(), None, "of what was left behind nobody hears");
    }
}
