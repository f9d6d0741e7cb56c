"""Writes the arrays that numpy_file_test.cpp reads, by NumPy itself, into the current folder."""

import zipfile

import numpy as np

cube = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)  # Two pings of three bins and four beams.
np.save("u1.npy", cube)
np.save("fortran.npy", np.asfortranarray(cube))
np.save("big.npy", cube.astype(">u2") * 1000)
np.save("f2.npy", np.array([[0.5, 1, 65504], [0, 2**-24, 2**-14]], dtype=np.float16))
np.save("f8.npy", np.linspace(0, 1, 6).reshape(2, 3))
np.save("big_f4.npy", np.linspace(0, 1, 5, dtype=">f4"))
np.save("i8.npy", np.array([[0, 7], [255, 1]]))
np.save("u4.npy", np.array([[0, 7], [256, 1]], dtype=np.uint32))
np.save("i2.npy", np.array([[-1, 7], [256, 1]], dtype=np.int16))
np.save("bool.npy", np.array([[True, False]]))
np.save("c8.npy", np.ones((2, 2), dtype=np.complex64))
np.save("object.npy", np.array([{}, []], dtype=object), allow_pickle=True)
np.save("record.npy", np.zeros(3, dtype=[("a", "<f4"), ("b", "<u2")]))
np.save("text.npy", np.array(["ab", "c"]))
np.save("four.npy", np.zeros((2, 2, 2, 2)))
np.save("none.npy", np.zeros((0, 3)))

bearing, spacing = np.array([-30.0, -10, 10, 30]), np.array([1.0, 2, 3])
np.savez("beam_bin.npz", polar=cube.transpose(0, 2, 1), bearing_deg=bearing, range_m=spacing)
np.savez_compressed("bin_beam.npz", anything=cube[1], bearing_deg=bearing, range_m=spacing)
np.savez("sides.npz", port=cube[0], starboard=cube[1], slant_range_m=np.float64(30))
np.savez("axes.npz", range_m=spacing)
np.savez_compressed("zeros.npz", intensity=np.zeros((200, 200), dtype=np.float32))

with zipfile.ZipFile("claims.npz", "w", zipfile.ZIP_DEFLATED) as archive:  # A header, and not the numbers that it names.
    head = "{'descr': '<f8', 'fortran_order': False, 'shape': (40000, 40000), }"
    head += " " * (63 - (len(head) + 10) % 64) + "\n"
    archive.writestr("intensity.npy", b"\x93NUMPY\1\0" + len(head).to_bytes(2, "little") + head.encode() + b"\0" * 64)
