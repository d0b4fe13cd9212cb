//! Tasks spread over threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// What a thread that compiles needs: enough for the deepest formula that the compiler accepts, in an unoptimised build too.
pub const STACK: usize = 256 << 20;

/// Does every task once, in their order as workers become free, each worker on a thread of its own. Gives the results in
/// the order of the tasks; none for a task whose thread died. `done` hears of every finished task.
pub(crate) fn spread<W: Send, T: Sync, R: Send>(
    workers: Vec<W>,
    tasks: &[T],
    work: impl Fn(&mut W, &T) -> R + Sync,
    mut done: impl FnMut(),
) -> Vec<Option<R>> {
    let mut results: Vec<Option<R>> = tasks.iter().map(|_| None).collect();
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        let (next, work) = (&next, &work);
        let mut threads = Vec::new();
        for mut worker in workers {
            let sender = sender.clone();
            let started =
                std::thread::Builder::new()
                    .stack_size(STACK)
                    .spawn_scoped(scope, move || {
                        loop {
                            let k = next.fetch_add(1, Ordering::Relaxed);
                            let Some(task) = tasks.get(k) else { break };
                            if sender.send((k, work(&mut worker, task))).is_err() {
                                break;
                            }
                        }
                    });
            threads.extend(started);
        }
        drop(sender);
        for (k, result) in receiver {
            results[k] = Some(result);
            done();
        }
        for thread in threads {
            // a panic has cost its task the result, which is all that it may
            let _ = thread.join();
        }
    });
    results
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_done_once_and_results_keep_their_order() {
        let tasks: Vec<usize> = (0..100).collect();
        let mut heard = 0;
        let work = |worker: &mut usize, task: &usize| {
            *worker += 1;
            task * 2
        };
        let results = spread(vec![0, 0, 0], &tasks, work, || heard += 1);
        let expected: Vec<Option<usize>> = (0..100).map(|k| Some(2 * k)).collect();
        assert_eq!(results, expected);
        assert_eq!(heard, 100);
    }

    #[test]
    fn a_panic_costs_one_result() {
        let work = |_: &mut (), &task: &usize| {
            assert_ne!(task, 1, "on purpose");
            task
        };
        let results = spread(vec![(), ()], &[0, 1, 2, 3], work, || ());
        assert_eq!(results, [Some(0), None, Some(2), Some(3)]);
    }
}
