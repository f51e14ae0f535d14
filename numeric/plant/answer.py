"""What `identify` returns: the findings, with methods to print, plot and save them.

Identification   the findings with summary, plot, save and to_json
"""

from __future__ import annotations

import html
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...base.errors import InvalidInput, quote_path
from ...base.progress import silent
from ...base.threads import one_thread
from .steps.findings import Answer


@dataclass(frozen=True, eq=False, repr=False)
class Identification(Answer):
    """What `identify` found. A field is None where it was not asked for, because of what came before.

    model            the MoespModel: A (n, n), B (n, n_u), C (p, n), D (p, n_u), x0 (n,), residual_covariance (p, p); None where the order
                     stays open, for which singular_values tell the choices
    residual         r (N, p) in units of y, with x0 and its covariance; `sizes` of its channels
    n_v, reason      the number of faults, None where it is undecided, and why; n_v_given: the caller stated it; counted_by: what it rests
                     on, a CountedBy; because: the reasons as codes with their numbers; `at_least` faults act in any case
    fault_space      the columns [f; g] that explain the residual: basis (n + p, n_z), orthonormal, and how sure it is
    onset            the samples from which on the residual is another one, with intervals, outputs and sizes in sigmas
    isolation        which single sensor or actuator lies in the fault space
    shift_isolation  which single sensor or actuator explains a shift of the mean of the residual, as a step or constant fault makes it
    pair, signal     F (n, n_v), G (p, n_v), one choice out of the space, and v (N, n_v) for it; explained: the share of the residual that
                     the signal explains, by_noise: what it would explain of noise
    doubts           what the record gives reason to doubt: evidence, what it does to the answer, what to do
    experiments      the same for each experiment by itself: its record, residual, onset, changes and signal, with the model, the number of
                     faults and the space of all; one experiment is its own, of several the whole has no onset, changes and signal
    initial_states   the state (n,) at the first sample of each experiment, that of a healthy record first
    notes            what a user must know, in whole sentences or nearly so; why an end was reached is among them

    order_given: the order was stated; held: the samples (first, last) that faults were counted on; dimension: the count on these; healthy:
    samples stated to be without fault, from the first on; `modelled` samples the model is from; counted_against: the samples of the healthy
    ones that `against` was counted against; mean: the test of the mean of the residual (against the healthy samples, or against zero where
    there are none and no means were removed); changes: the table of what has changed since the healthy samples, or of the little that the
    second half of a record shows against the first; news: how many of the faults counted against the healthy samples are more than
    residual and inputs foretell, None where that was not asked; healthy_record: these came in a record of their own; unexplained: the
    healthy samples are explained to rounding, the others are not; visible (p,): the standard deviation of a white fault at one
    output that would be seen; dt: the sample time in seconds, where it was stated or a time column tells it.

    `summary()` tells people what was found, `plot()` draws it, `save(folder)` writes all of it, and `to_json()`, `to_control()`,
    `to_scipy()`, `to_pandas()` and `to_mat(path)` hand it to other programs. Raises InvalidData where one of these needs a model and there
    is none, and ImportError where it needs a package that is not installed. Source: [V93], [G25].

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, identify
    >>> u = np.random.default_rng(1).standard_normal((400, 1))
    >>> identify(StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [1.0]]).simulate(u), u)
    <Identification of 400 samples: order 1, n_v 0, n_z None, no signal>
    """

    def __repr__(self) -> str:
        order = "undecided" if self.model is None else self.model.order
        n_v = "undecided" if self.n_v is None else self.n_v
        n_z = self.fault_space.n_z if self.fault_space is not None and self.fault_space.meaningful else None
        found = "no signal" if all(one.signal is None for one in self.experiments) else "with a signal"
        of = f" in {len(self.parts)} experiments" if self.parts else ""
        return f"<Identification of {len(self.record)} samples{of}: order {order}, n_v {n_v}, n_z {n_z}, {found}>"

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the summary."""
        return f"<pre>{html.escape(self.summary())}</pre>"

    @one_thread()
    def summary(self, title: str = "Identification") -> str:
        """Tell people what was found, in lines of Markdown under this title."""
        from .report.summary import summary

        return "\n".join(summary(self, title))

    @one_thread()
    def to_json(self, data: str = "arrays") -> dict[str, Any]:
        """Return everything but the signals as a JSON-ready dict, by the schema identify.schema.json; `data` says where the record is
        from."""
        from .report.result_files import document

        return document(self, data)

    @one_thread()
    def plot(self, ax: Any = None) -> Any:
        """Draw the fault signal, or measured and simulated outputs where there is none, into the matplotlib axes `ax` (new ones where None
        are given) and returns them. Raises InvalidData where there is no model, and ModuleNotFoundError without matplotlib."""
        from .report.result_pictures import main_picture

        return main_picture(self, ax)

    def to_control(self) -> Any:
        """Return the model as a control.StateSpace of python-control, with the names of inputs and outputs and the sample time.

        A model whose sample time was not stated is of discrete time with a time unstated (dt=True). Raises InvalidData where there is no
        model, and ImportError without python-control.
        """
        from .report.other_programs import handed_on

        return handed_on(self).to_control(dt=self.dt, inputs=self.record.inputs, outputs=self.record.outputs)

    def to_scipy(self) -> Any:
        """Return the model as a scipy.signal.dlti with the sample time, 1 where none was stated. Raises InvalidData where there is no
        model."""
        from .report.other_programs import handed_on

        return handed_on(self).to_scipy(dt=self.dt)

    def to_mat(self, path: str | os.PathLike[str]) -> None:
        """Write A, B, C, D, F, G, x0, the names `inputs` and `outputs` and the sample time `dt` into a MAT file, which MATLAB loads.

        F and G have no columns where no pair was found; dt is -1, which is MATLAB's word for unstated, where none was stated. Raises
        InvalidData where there is no model, and InvalidInput for a path that cannot be written.
        """
        from .report.other_programs import to_mat

        to_mat(self, path)

    def to_pandas(self) -> Any:
        """Return a DataFrame with a row a sample: the channels, the residual in units of y, and the fault signal, NaN where that is not
        determined.

        Columns are pairs: ("input", name), ("output", name), ("residual", name of the output), ("onset", "before"), which counts the
        onsets before a sample, ("fault", "v1"), ..; the index is the time
        in seconds from the first sample, or the number of the sample where the sample time is not known. All samples are read into
        memory. Raises ImportError without pandas.
        """
        from .report.other_programs import to_pandas

        return to_pandas(self)

    @one_thread()
    def save(self, folder: str | os.PathLike[str], data: str = "arrays") -> list[str]:
        """Write model, residual, fault space, fault signal, summary and pictures into `folder`, which is made where it is missing; their
        names.

        `data` is the title of the summary, which says where the record is from: "arrays" unless it is named. The summary also tells what
        could not be had, as pictures without matplotlib. Of what is in the folder, only the files that an earlier `save` or `faultspace
        identify` wrote there are replaced, or removed where this answer has no such file; the hidden file .faultspace-files.json tells
        which they are. Raises InvalidInput where the folder cannot be written into, and where it has a file of a name that is needed,
        model.json for example, which an earlier run did not write or which has been changed since: nothing is written then, and a new
        folder is the way out (also for results of versions before 0.1, which left no such file).

        >>> import numpy as np, pathlib, tempfile
        >>> from faultspace.numeric import StateSpaceModel, identify
        >>> u = np.random.default_rng(1).standard_normal((400, 1))
        >>> found = identify(StateSpaceModel([[0.5]], [[1.0]], [[1.0], [2.0]], [[0.0], [1.0]]).simulate(u), u)
        >>> found.save(pathlib.Path(tempfile.mkdtemp(), "result"), data="a simulated tank")[0]
        'model.json'
        """
        from .report.result_files import write

        path = Path(folder)
        try:
            path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InvalidInput(
                f"{quote_path(str(path))}: cannot be made ({error.strerror or error}), expected a folder to write into"
            ) from None
        return write(self, path, data, silent)[0]
