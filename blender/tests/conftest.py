"""The extension, in an interpreter that has `bpy` (`pip install bpy`, any of 4.2 to 5.2).

With TRESS_EXTENSION naming the archive that `cargo xtask extension` makes, the archive is installed
into a user folder of its own and the add-on enabled as Blender does it, wheel and all; otherwise
the sources in `addon` are registered, and `tress` is the installed package.
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

import pytest

ARCHIVE = os.environ.get("TRESS_EXTENSION")
if ARCHIVE:
    os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="tress-blender-")

if importlib.util.find_spec("bpy") is not None:
    import bpy
else:
    collect_ignore_glob = ["test_*.py"]

INSTALL = """
import bpy, sys
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=False)
"""


def pytest_report_header():
    if "bpy" not in sys.modules:
        return "no bpy: the tests of the Blender extension are left out"
    return f"bpy {bpy.app.version_string}, {ARCHIVE or 'add-on from its sources'}"


def installed():
    """The add-on out of the archive; Blender only takes up wheels when it starts."""
    import addon_utils

    subprocess.run([sys.executable, "-c", INSTALL, ARCHIVE], check=True)
    sys.modules.pop("bl_ext", None)
    addon_utils._initialize_extensions_repos_once()
    addon_utils.extensions_refresh(ensure_wheels=True)
    module = addon_utils.enable("bl_ext.user_default.tress")
    assert module is not None, "Blender did not enable the extension"
    return module


def from_sources():
    """The add-on from its sources."""
    source = pathlib.Path(__file__).parents[1] / "addon" / "__init__.py"
    spec = importlib.util.spec_from_file_location(
        "tress_blender", source, submodule_search_locations=[str(source.parent)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["tress_blender"] = module
    spec.loader.exec_module(module)
    module.register()
    return module


@pytest.fixture(scope="session")
def addon():
    """The add-on, registered; its modules are its attributes."""
    return ADDON


@pytest.fixture
def scene(addon):
    """A scene with nothing in it."""
    for kind in (bpy.data.objects, bpy.data.hair_curves, bpy.data.collections, bpy.data.meshes):
        for block in list(kind):
            kind.remove(block)
    addon.rig.forget()
    layer = bpy.context.view_layer
    layer.active_layer_collection = layer.layer_collection
    return bpy.context.scene


if "bpy" in sys.modules:
    # Before the tests are imported: with an archive, `tress` is what it carries.
    ADDON = installed() if ARCHIVE else from_sources()
