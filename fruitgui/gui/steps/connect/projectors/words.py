"""What trying the projectors came to, in the operator's language."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.calibration.projectors.interference import Harm, Interference
from fruitgui.calibration.projectors.settling import Refusal, Settled
from fruitgui.gui.numbers import THIN, count_text, number_text
from fruitgui.station.turn_plan import TurnPlan

translate = QCoreApplication.translate

HEALTH = {Harm.NONE: "good", Harm.SOME: "warn", Harm.MUCH: "bad"}


def harm_word(harm: Harm) -> str:
    """Return how much a sensor is harmed, in a word or two."""
    return {
        Harm.NONE: translate("Projectors", "undisturbed"),
        Harm.SOME: translate("Projectors", "disturbed"),
        Harm.MUCH: translate("Projectors", "blinded"),
    }[harm]


def settled_text(settled: Settled) -> str:
    """Return how long a light takes to settle."""
    text = translate("Projectors", "steady after {time}; {frames} pictures are left out; {holes} without depth")
    return text.format(
        time=f"{number_text(settled.settle_s, 2)}{THIN}s", frames=count_text(settled.discard_frames),
        holes=_share(settled.steady.holes),
    )  # fmt: skip


def refusal_text(refusal: Refusal) -> str:
    """Return why nothing could be told of a sensor, and what to do."""
    return {
        Refusal.TOO_FEW: translate("Projectors", "Too few pictures came. Check the cable, then measure again."),
        Refusal.BLIND: translate(
            "Projectors", "It sees nothing. Point it at the belt, keep the sun out, then measure again."
        ),
        Refusal.MOVED: translate(
            "Projectors", "Something moved meanwhile. Let the belt stand and nobody pass, then measure again."
        ),
        Refusal.UNSTEADY: translate(
            "Projectors", "Its light did not become steady. Let it warm up for ten minutes, then measure again."
        ),
    }[refusal]


def change_text(seen: Interference) -> str:
    """Return what another's light changes for a sensor: holes and noise, alone and together."""
    text = translate("Projectors", "without depth {alone} → {together}, noise {quiet} → {loud}")
    return text.format(
        alone=_share(seen.holes_alone), together=_share(seen.holes_together),
        quiet=_mm(seen.noise_alone_mm), loud=_mm(seen.noise_together_mm),
    )  # fmt: skip


def untold_text() -> str:
    """Return what is said of two of which too few pictures came while both shone."""
    return translate("Projectors", "Too few pictures came while both were on.")


def effect_text(before: TurnPlan, after: TurnPlan) -> str:
    """Return what keeping it changes: pictures a second and the belt's highest speed."""
    text = translate(
        "Projectors",
        "Pictures a second, each: {rate_before} → {rate_after}. Belt up to {speed_before} → {speed_after}.",
    )
    return text.format(
        rate_before=_rate(before), rate_after=_rate(after),
        speed_before=_speed(before.highest_speed_m_s), speed_after=_speed(after.highest_speed_m_s),
    )  # fmt: skip


def _rate(plan: TurnPlan) -> str:
    return number_text(min(plan.rates_hz.values()), 1)


def _share(share: float) -> str:
    return f"{number_text(100.0 * share, 1)}{THIN}%"


def _mm(value: float) -> str:
    return f"{number_text(value, 1)}{THIN}mm"


def _speed(value: float) -> str:
    return f"{number_text(value, 2)}{THIN}m/s"
