# SPDX-License-Identifier: GPL-3.0-or-later
"""A stub of slicer, with nodes that lie under transforms, bear attributes and have storage nodes as Slicer's do."""
import shutil
from pathlib import Path
from unittest.mock import MagicMock


class Nodes:
    """Its loaders take files that are there alone."""

    def __init__(self):
        self.slicer, self.loaded, self.by_id = MagicMock(), {}, {}
        for kind in ("Volume", "Segmentation", "Transform", "Model"):
            getattr(self.slicer.util, f"load{kind}").side_effect = self._loader(kind)
        self.slicer.util.exportNode.side_effect = self._export
        self.exported = {}
        self.points = []
        self.slicer.mrmlScene.AddNewNodeByClass.side_effect = self._add

    def node(self, name, under=None, **known):
        node = MagicMock(under=under, attributes={}, storage=None, **known)
        node.GetName.return_value = name
        node.GetID.return_value = f"{name} {len(self.by_id)}"
        self.by_id[node.GetID()] = node
        node.GetAttribute.side_effect = node.attributes.get
        node.SetAttribute.side_effect = node.attributes.__setitem__
        node.GetParentTransformNode.side_effect = lambda: node.under
        node.SetAndObserveTransformNodeID.side_effect = lambda key: self._put(node, self.by_id.get(key))
        node.GetStorageNode.side_effect = lambda: node.storage
        node.SetAndObserveStorageNodeID.side_effect = lambda key: setattr(node, "storage", self.by_id.get(key))
        return node

    def result(self, name, under=None):
        """A transform that an earlier Apply has left."""
        node = self.node(name, under)
        node.SetAttribute("BrainShift.result", "1")
        return node

    @staticmethod
    def above(node):
        """What a node lies under, the nearest first."""
        chain = []
        while (node := node.GetParentTransformNode()) is not None:
            chain.append(node)
        return chain

    def _put(self, node, above):
        assert above is None or node not in [above, *self.above(above)], "Slicer makes no circle"
        node.under = above

    def _loader(self, kind):
        def load(file, properties=None):
            assert Path(file).is_file(), file
            node = self.node(kind)
            node.storage = self.node("storage", file=file)
            node.GetSegmentation().GetNumberOfSegments.return_value = 2
            node.GetSegmentation().GetNthSegment(0).GetLabelValue.return_value = 3
            self.loaded[Path(file).name] = node
            return node

        return load

    def _export(self, node, file, properties={}, world=False):  # one dictionary for all calls, as in Slicer
        assert properties.setdefault("fileFormat", Path(file).suffixes) == Path(file).suffixes
        self.exported[Path(file).name.partition(".")[0]] = self.above(node) if world else []
        return bool(shutil.copy(node.file, file))

    def _add(self, kind, name):
        assert kind == "vtkMRMLMarkupsFiducialNode"
        self.points.append(self.node(name))
        return self.points[-1]
