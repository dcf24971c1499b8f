# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in of 3D Slicer: calls a command-line module by the rules of the Slicer Execution Model.

It reads the module's description, writes the nodes that are chosen to files of the types that Slicer writes, makes the
command line as Slicer does (Base/Logic/vtkSlicerCLIModuleLogic.cxx), follows the progress, loads what comes out, and
cancels by a kill. As Slicer, it loads nothing of a module that fails.
"""
import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path
from xml.etree import ElementTree

DATA = ("image", "geometry", "transform", "table", "measurement", "pointfile")
QUIET_WHEN_EMPTY = ("file", "directory", "string", "double-vector", "float-vector", "integer-vector", "string-vector")
ENDINGS = {"image": ".nrrd", "geometry": ".vtp", "transform": ".h5", "pointfile": ".fcsv"}
TAGS = re.compile(r"<filter-(progress|comment|name)>([^<]*)</filter-\1>")


class Parameter:
    def __init__(self, element):
        self.tag, self.attributes = element.tag, element.attrib
        self.flag = element.findtext("longflag") or ""
        self.name = element.findtext("name")
        self.default = element.findtext("default", "")
        self.channel = element.findtext("channel", "")
        self.choices = [choice.text for choice in element.findall("element")]
        if not re.fullmatch(r"[a-zA-Z_][a-zA-Z0-9_]*", self.flag or self.name):
            raise ValueError(f"{self.flag or self.name}: Slicer takes letters, digits and underscores")
        if self.choices and self.default not in self.choices:
            raise ValueError(f"{self.name}: its default is none of its choices")

    def is_returned(self):
        return self.channel == "output" and not self.flag

    def ending(self):
        return self.attributes.get("fileExtensions", ENDINGS.get(self.tag, "")).split(",")[0]


class Module:
    """The module at a path, described by its --xml within five seconds, or by the .xml beside it."""

    def __init__(self, path, environment=None):
        self.path = Path(path)
        self.environment = {**os.environ, **(environment or {})}
        asked = subprocess.run([path, "--xml"], capture_output=True, text=True, timeout=5, env=self.environment)
        if asked.returncode or asked.stderr or not asked.stdout.startswith("<?xml"):
            raise ValueError(f"no module: {asked.stderr}")
        if self.path.with_suffix(".xml").read_text() != asked.stdout:
            raise ValueError("the description beside the module is another one")
        groups = ElementTree.fromstring(asked.stdout).findall("parameters")
        self.parameters = [Parameter(e) for g in groups for e in g if e.tag not in ("label", "description")]

    def command(self, chosen, scratch):
        """The command line, and the files that are to be loaded afterwards."""
        words, to_load = [str(self.path)], {}
        if any(p.is_returned() for p in self.parameters):
            words += ["--returnparameterfile", str(scratch / "module.params")]
        for p in (p for p in self.parameters if p.flag):
            value = chosen.get(p.name, "" if p.tag in DATA else p.default)
            if p.tag == "boolean":
                words += [f"--{p.flag}"] if value == "true" else []
            elif p.tag not in DATA:
                words += [f"--{p.flag}", str(value)] if str(value) or p.tag not in QUIET_WHEN_EMPTY else []
            elif value:
                file = scratch / f"{p.name}{p.ending()}"
                if p.channel == "input":
                    shutil.copy(value, file)
                else:
                    to_load[p.name] = file
                words += [f"--{p.flag}", str(file)]
        return words, to_load

    def start(self, chosen):
        return Call(self, chosen)


class Call:
    """A call of a module. chosen: {name: file of an input, True for an output, value of an option}."""

    def __init__(self, module, chosen):
        self.scratch = Path(tempfile.mkdtemp(dir=module.environment.get("TMPDIR")))
        words, self.to_load = module.command(chosen, self.scratch)
        with open(self.scratch / "stderr", "w") as errors:
            self.process = subprocess.Popen(
                words, stdout=subprocess.PIPE, stderr=errors, text=True, env=module.environment
            )
        self.progress, self.comments, self.names, self.output = [], [], [], ""

    def follow(self, until=None):
        """Reads what the module says, to its end or to a comment that begins so."""
        for line in self.process.stdout:
            for what, text in TAGS.findall(line):
                {"progress": self.progress, "comment": self.comments, "name": self.names}[what].append(text)
            self.output += TAGS.sub("", line)
            if until and self.comments and self.comments[-1].startswith(until):
                return self
        self.process.stdout.close()
        self.process.wait()
        return self

    def cancel(self, how=signal.SIGKILL):
        """As Slicer does, which knows the module's process alone."""
        self.process.send_signal(how)
        self.process.stdout.close()
        self.process.wait()

    def errors(self):
        return (self.scratch / "stderr").read_text()

    def loaded(self):
        """{name: bytes} of the outputs that are there, and what is returned; nothing of a module that failed."""
        if self.process.returncode != 0:
            return {}, {}
        text = (self.scratch / "module.params").read_text()
        returned = dict((word.strip() for word in line.split("=", 1)) for line in text.splitlines())
        return {name: file.read_bytes() for name, file in self.to_load.items() if file.exists()}, returned
