# SPDX-License-Identifier: BSD-3-Clause
"""Builds the wheel of the Python module for pip (PEP 517): the module, its compiled parts, and the libraries of the suite."""
import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "urban_nav_python"
DEVEL = ROOT / "build" / "ws" / "devel" / "lib"
RUNPATH = b"$ORIGIN:$ORIGIN/lib"


def version():
    """The version of the suite, as package.xml has it."""
    return re.search(r"<version>([^<]+)</version>", (PACKAGE / "package.xml").read_text()).group(1)


def tag():
    """The wheel's tag: of this Python and this platform."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def compiled():
    """The compiled parts of the module, after a build. Throws RuntimeError if they are for another Python."""
    subprocess.run(["bash", "-c", f'. "{ROOT}/scripts/lib.sh" && build_command'], check=True, stdin=subprocess.DEVNULL)
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    found = sorted((DEVEL / "python3" / "dist-packages" / "urban_nav").glob("*.so"))
    if not found or any(not path.name.endswith(suffix) for path in found):
        raise RuntimeError(f"the module is built for /usr/bin/python3, not for {sys.executable} ({suffix}): run pip by /usr/bin/python3")
    return found


def libraries(parts):
    """The libraries of the suite that these need."""
    lines = subprocess.run(["ldd", *map(str, parts)], capture_output=True, text=True, check=True).stdout
    paths = {Path(path) for path in re.findall(r"=> (/\S+)", lines)}
    return sorted(path for path in paths if path.parent == DEVEL)


def relocated(path):
    """The bytes of a library that looks for others beside it and in lib/."""
    content = path.read_bytes()
    table = subprocess.run(["readelf", "-d", str(path)], capture_output=True, text=True, check=True).stdout
    for old in re.findall(r"\((?:RUNPATH|RPATH)\)[^\[]*\[([^\]]*)\]", table):
        old = old.encode()
        if len(old) < len(RUNPATH):
            raise RuntimeError(f"{path}: its RUNPATH {old.decode()} leaves no room for {RUNPATH.decode()}")
        content = content.replace(b"\0" + old + b"\0", b"\0" + RUNPATH.ljust(len(old), b"\0") + b"\0")
    return content


def metadata():
    return f"Metadata-Version: 2.1\nName: urban_nav\nVersion: {version()}\nRequires-Python: >=3.8\nRequires-Dist: numpy\n"


def contents():
    """{name in the wheel: bytes}."""
    parts = compiled()
    files = {f"urban_nav/{path.name}": path.read_bytes() for path in sorted((PACKAGE / "python" / "urban_nav").iterdir()) if path.is_file()}
    files.update({f"urban_nav/{path.name}": relocated(path) for path in parts})
    files.update({f"urban_nav/lib/{path.name}": relocated(path) for path in libraries(parts)})
    info = f"urban_nav-{version()}.dist-info"
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: urban_nav\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    return files


def record(files, name):
    """The table of the wheel's files with their digests."""
    rows = [f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b'=').decode()},{len(content)}"
            for path, content in files.items()]
    return "\n".join([*rows, f"{name},,"]) + "\n"


def write_wheel(folder, files):
    """Writes the wheel; returns its name."""
    wheel = f"urban_nav-{version()}-{tag()}.whl"
    name = f"urban_nav-{version()}.dist-info/RECORD"
    with zipfile.ZipFile(Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in {**files, name: record(files, name).encode()}.items():
            entry = zipfile.ZipInfo(path)  # without a date: the same files give the same bytes
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            archive.writestr(entry, content)
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):  # pylint: disable=unused-argument
    return write_wheel(wheel_directory, contents())


def build_sdist(sdist_directory, config_settings=None):  # pylint: disable=unused-argument
    raise RuntimeError("the suite is installed from its repository: pip install .")
