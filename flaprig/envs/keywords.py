"""Keyword arguments of `gymnasium.make` that change single settings of an environment."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any, TypeVar

from flaprig import _checks as check

Settings = TypeVar("Settings", bound=Any)


def changed(
    owner: str,
    kind: type[Settings],
    settings: Settings | None,
    changes: dict[str, Any],
    inner: str | None = None,
    more: tuple[str, ...] = (),
) -> Settings:
    """Settings with some of them changed by name.

    Args:
        owner: whose settings, for the sentence.
        kind: a frozen dataclass.
        settings: one of that kind, or None for its defaults.
        changes: new values by name.
        inner: a setting that is itself a dataclass, whose names are taken too; what is changed in
            it comes on top of a new value of the whole.
        more: names that the caller takes himself, for the sentence.

    Raises:
        ValueError: settings of another kind, no such setting, or a value that it cannot have.
    """
    settings = kind() if settings is None else settings
    if not isinstance(settings, kind):
        raise check.fail(owner, "settings", f"a {kind.__name__}", settings)

    own = [field.name for field in fields(settings)]
    below = [field.name for field in fields(getattr(settings, inner))] if inner else []
    for name in changes:
        if name not in own + below:
            allowed = f"one of settings, render_mode, {', '.join([*more, *own, *below])}"
            raise check.fail(owner, "keyword", allowed, name)

    settings = replace(settings, **{name: changes[name] for name in own if name in changes})
    nested = {name: changes[name] for name in below if name in changes}
    if inner and nested:
        settings = replace(settings, **{inner: replace(getattr(settings, inner), **nested)})
    return settings
