"""flaprig/HoverRig-v0: strokes flown by the motors of the rig."""

from __future__ import annotations

from typing import Any

from flaprig.envs.hover_env import HoverEnv
from flaprig.envs.keywords import changed
from flaprig.tasks.hover_rig import HoverRigSettings


class HoverRig(HoverEnv):
    """
    ## Description

    Find the hovering stroke that gives most lift and most lift over drag when the rig's motors fly
    it: each action is a new stroke, taken through the limits, Ruckig and the servos into MuJoCo,
    from rest in still water, for some cycles.

    ## Action Space

    `Box(-1.0, 1.0, (12,), float32)`: the change of each coefficient, in units of `step_size`.

    | Num   | Action                                        | Min | Max |
    |-------|-----------------------------------------------|-----|-----|
    | 0-2   | change of the sweep's cosines, harmonics 1-3  | -1  | 1   |
    | 3-5   | change of the sweep's sines, harmonics 1-3    | -1  | 1   |
    | 6-8   | change of the pitch's cosines, harmonics 1-3  | -1  | 1   |
    | 9-11  | change of the pitch's sines, harmonics 1-3    | -1  | 1   |

    Afterwards the largest coefficient of each angle is scaled to 1, which leaves the stroke as it
    is: the observation decides what an action will do.

    ## Observation Space

    `Box(-1.0, 1.0, (200,), float32)`: one cycle of the stroke at equal steps from time 0.

    | Num     | Observation                                            | Min | Max |
    |---------|--------------------------------------------------------|-----|-----|
    | 0-99    | sweep angle over the sweep amplitude (equation 10)     | -1  | 1   |
    | 100-199 | pitch angle over the pitch amplitude (equation 11)     | -1  | 1   |

    ## Rewards

    `r1 C_L + r2 (C_L/C_D - C_Ref) - r3 |C_side| - r4 |asymmetry|` of the cycle means, with
    r1 = 0.1, r2 = 12, r3 = 10, r4 = 2.5 and C_Ref the sinusoid's ratio by the same model; `-r5`,
    r5 = 2, for a stroke beyond the bounds or one whose simulation failed. All are settings.

    `info` holds each term (`reward_lift`, `reward_ratio`, `reward_side`, `reward_asymmetry`), the
    means `cl`, `cd`, `lift_to_drag`, `side`, `asymmetry` (NaN for a stroke that was not simulated),
    `peak_sweep_acceleration` and `peak_pitch_acceleration` in rad/s2, `coefficients`,
    `bounds_exceeded`, and `failure` (a sentence) when the loads or the action were not finite.

    ## Starting State

    The sinusoid, with normal noise of standard deviation `jitter` on the coefficients.

    ## Episode End

    - Termination: an acceleration exceeds its bound (equation 13), the rig refuses the stroke,
      MuJoCo gives up, or the action was not finite.
    - Truncation: `horizon` actions, 50 by default.

    ## Arguments

    `settings`: a `flaprig.tasks.HoverRigSettings`: the `problem` (a `HoverSettings`), the `motors`,
    MuJoCo's `time_step`, `feedforward`, the `limits` and the `link` to the servos. Each setting,
    the problem's too, is also a keyword of its own, which overrides `settings`.

    ```python
    import gymnasium, flaprig.envs
    env = gymnasium.make("flaprig/HoverRig-v0", horizon=20, jitter=0.02)
    ```

    ## Version History

    - v0: first version.
    """

    def __init__(
        self,
        settings: HoverRigSettings | None = None,
        render_mode: str | None = None,
        **changes: Any,
    ) -> None:
        chosen = changed("HoverRig", HoverRigSettings, settings, changes, inner="problem")
        super().__init__(chosen, render_mode)
