# SPDX-License-Identifier: BSD-3-Clause
"""The program reliefshade: where it is, what it tells of itself, and its runs."""

import functools
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

from processing.core.ProcessingConfig import ProcessingConfig

SETTING = "RELIEFSHADE_PROGRAM"


class Failure(Exception):
    """The program is not there, or could not do what was asked; the text says why."""


def find():
    """The program's path: as it is set, by the environment's RELIEFSHADE, or in PATH."""
    for place in (ProcessingConfig.getSetting(SETTING), os.environ.get("RELIEFSHADE"),
                  "reliefshade"):
        found = shutil.which(place) if place else None
        if found:
            return found
        if place and place != "reliefshade":
            raise Failure(f"'{place}' is no program; name the program reliefshade in the options of "
                          "Processing, or leave the field empty")
    raise Failure("the program reliefshade is not found; install it, or name it in the options of "
                  "Processing (Providers, ReliefShading)")


def parameters():
    """What the program says of the parameters of a scene: a list of dictionaries."""
    return _parametersOf(find())


@functools.lru_cache(maxsize=1)
def _parametersOf(path):
    done = subprocess.run([path, "--parameters"], stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, encoding="utf-8", check=False)
    if done.returncode != 0:
        raise Failure(f"'{path}' does not tell its parameters; the version that belongs to this "
                      f"plugin is expected: {done.stderr.strip()}")
    return json.loads(done.stdout)


def textOf(file):
    """What a temporary file holds, without the blanks around it."""
    file.seek(0)
    return file.read().decode("utf-8", "replace").strip()


def run(words, feedback):
    """Runs the program; a Failure has its message. Returns False if it was canceled."""
    path = find()
    feedback.pushCommandInfo(subprocess.list2cmdline([path, *words]))
    # Files, since nobody empties a pipe while the program runs.
    with tempfile.TemporaryFile() as outputs, tempfile.TemporaryFile() as errors:
        with subprocess.Popen([path, *words], stdin=subprocess.DEVNULL, stdout=outputs,
                              stderr=errors) as process:
            canceled = False
            while process.poll() is None:
                if feedback.isCanceled() and not canceled:
                    # It removes what it has begun.
                    process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
                    canceled = True
                time.sleep(0.05)
        output, message = (textOf(file) for file in (outputs, errors))
    if canceled:
        return False
    if process.returncode != 0:
        raise Failure(re.sub(r"^reliefshade: ", "", message) or
                      f"reliefshade ended with {process.returncode}")
    for line in message.splitlines():
        feedback.pushWarning(re.sub(r"^reliefshade: (warning: )?", "", line))
    if output:
        feedback.pushInfo(output)
    return True
