"""Hold a reader and the schema that ships beside it against each other, on documents changed in a few places.

Agreement   a reader, its schema, and what the schema leaves to the reader; `check` holds them together on a document
places      the containers of a document with their keys
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any

import jsonschema

from faultspace.base.errors import InvalidInput

Json = Any


def places(document: Json) -> list[tuple[Json, Any]]:
    """These are all containers in the document, each with each of its keys or indices."""
    keys = list(document) if isinstance(document, dict) else list(range(len(document))) if isinstance(document, list) else []
    return [(document, key) for key in keys] + [place for key in keys for place in places(document[key])]


@dataclass(frozen=True)
class Agreement:
    """`read` and `schema` accept the same documents, but for the reader's words that `beside` finds.

    `odd` are the values that are put in the place of others, and `keys` the names that they are put under.
    """

    read: Callable[[Json], object]
    schema: Json
    beside: re.Pattern[str]
    keys: tuple[str, ...]
    odd: tuple[Json, ...]

    def changed(self, document: Json, rng: Random) -> Json:
        """The result differs from the document in one place: a value is removed, repeated, replaced, or there is one more."""
        result = copy.deepcopy(document)
        container, key = rng.choice(places(result))
        kind = rng.randrange(4)
        if kind == 0:
            del container[key]
        elif kind == 1 and isinstance(container, list):
            container.insert(key, copy.deepcopy(container[key]))
        elif kind == 2:
            result[rng.choice(self.keys)] = copy.deepcopy(rng.choice(self.odd))
        else:
            container[key] = copy.deepcopy(rng.choice(self.odd))
        return result

    def complaint(self, document: Json) -> str | None:
        """The result is what the reader says against the document, None where it reads it."""
        try:
            self.read(document)
        except InvalidInput as error:
            return str(error)
        return None

    def accepts(self, document: Json) -> bool:
        """The result says whether the document is one that the schema allows."""
        return bool(jsonschema.Draft202012Validator(self.schema).is_valid(document))

    def check(self, document: Json) -> None:
        """What is read agrees with the schema; what is not read breaks it too, or a rule that its description tells besides."""
        said = self.complaint(document)
        agrees = self.accepts(document)
        assert agrees or said is not None, document
        assert not agrees or said is None or self.beside.search(said), (said, document)
