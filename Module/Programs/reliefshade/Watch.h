// SPDX-License-Identifier: BSD-3-Clause
#ifndef Watch_h
#define Watch_h

class vtkAlgorithm;

namespace reliefshade
{

/// Lets SIGINT and SIGTERM end the run in order: long steps stop at their next progress event and
/// take their unfinished files away. A second signal ends the program at once.
void catchSignals();

/// Ends a run as a signal does, from any thread; false lets the next one go on.
void interrupt(bool on);

/// Whether one of these signals has come, or interrupt() was called.
bool interrupted();

/// Throws the failure that ends an interrupted run.
void stopIfInterrupted();

/// Aborts the algorithm once it is interrupted and, if `bar`, draws its progress, with what it
/// does, on the standard error stream. It must outlive its last update.
void watch(vtkAlgorithm* algorithm, bool bar, const char* what = "shading");

/// Draws, if `bar`, what is done of a step that is no algorithm's; all of it clears the line.
void showProgress(bool bar, const char* what, double share);

/// Updates an algorithm until it is done or interrupted. Throws the failure that ends an
/// interrupted run, or a std::runtime_error with what the algorithm says.
void runToEnd(vtkAlgorithm* algorithm);

/// Whether a progress bar would be seen: the standard error stream is a terminal.
bool terminal();

}

#endif
