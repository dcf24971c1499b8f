"""The compression of the cylinder with nu = 0.499: ten times nearer to incompressible."""
import sys

from . import cylinder_compression

if __name__ == "__main__":
    cylinder_compression.main(*sys.argv[1:], nu=0.499, name="cylinder_compression_nu0499")
