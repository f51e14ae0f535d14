"""What the build cannot be told in pyproject.toml: the folders of the rooms stand at the top of the tree, and their import names are
faultspace.*. The symbolic links in faultspace/ serve tools that read a clone without building it, and no build follows them."""

from setuptools import find_packages, setup

ROOMS = ("exact", "numeric", "proofs")

front = find_packages(include=["faultspace", "faultspace.*"], exclude=[f"faultspace.{room}*" for room in ROOMS])
rooms = [f"faultspace.{name}" for name in find_packages(include=[*ROOMS, *(f"{room}.*" for room in ROOMS)])]
setup(packages=[*front, *rooms], package_dir={f"faultspace.{room}": room for room in ROOMS})
