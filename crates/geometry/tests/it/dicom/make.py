"""Writes the DICOM files next to it: needs highdicom 0.28, pydicom 3, imagecodecs 2026.3 (libjpeg-turbo, OpenJPEG,
CharLS), and `dcmcjpeg` and `dcmconv` of DCMTK 3.6.7.

Two balls of known place and radius in an oblique series of ten images of 24 x 20 pixels, as a segmentation with a bit for
each pixel, with a part of 255 for each, and as a map of labels, all also compressed; one of the images, with a name and a
date in it; and labels of 16 bits that differ from voxel to voxel, also compressed by lossless JPEG of all kinds.
"""

import copy
import subprocess
import zlib
from pathlib import Path

import highdicom as hd
import imagecodecs
import numpy as np
from pydicom import dcmwrite
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.encaps import encapsulate
from pydicom.sr.codedict import codes
from pydicom.uid import (
    UID,
    CTImageStorage,
    ExplicitVRLittleEndian,
    JPEG2000Lossless,
    JPEGLossless,
    JPEGLSLossless,
    RLELossless,
)

DeflatedImageFrame = UID("1.2.840.10008.1.2.8.1")

HERE = Path(__file__).parent
# Millimetres in the patient: left, back, head.
ORIGIN = np.array([-30.0, 12.5, 100.0])
TURN = np.deg2rad(30.0)
ALONG = np.array([np.cos(TURN), np.sin(TURN), 0.0])
DOWN = np.array([0.0, 0.0, -1.0])
NORMAL = np.cross(ALONG, DOWN)
COLUMN, ROW, SLICE = 1.0, 1.5, 2.5
COLUMNS, ROWS, SLICES = 24, 20, 10
# Middle (along, down, normal) [voxels] and radius [mm].
BALLS = [((8.0, 8.0, 4.0), 6.0), ((17.0, 12.0, 6.0), 4.0)]


def root() -> str:
    """A root for identifiers that are the same in each run."""
    return "1.2.826.0.1.3680043.10.511.3"


def image(number: int) -> Dataset:
    """An image of the series."""
    meta = FileMetaDataset()
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    meta.MediaStorageSOPClassUID = CTImageStorage
    meta.MediaStorageSOPInstanceUID = f"{root()}.1.{number + 1}"
    made = Dataset()
    made.file_meta = meta
    made.SOPClassUID = CTImageStorage
    made.SOPInstanceUID = meta.MediaStorageSOPInstanceUID
    made.StudyInstanceUID = f"{root()}.2"
    made.SeriesInstanceUID = f"{root()}.3"
    made.FrameOfReferenceUID = f"{root()}.4"
    made.Modality = "CT"
    made.PatientName = "Nobody^Nemo"
    made.PatientID = "4711"
    made.PatientBirthDate = "19700102"
    made.PatientSex = "O"
    made.StudyDate = "20200304"
    made.StudyTime = "101112"
    made.StudyID = "1"
    made.AccessionNumber = "1"
    made.ReferringPhysicianName = "Somebody^Else"
    made.SeriesNumber = 1
    made.InstanceNumber = number + 1
    made.Rows, made.Columns = ROWS, COLUMNS
    made.PixelSpacing = [ROW, COLUMN]
    made.SliceThickness = SLICE
    made.ImageOrientationPatient = [*ALONG, *DOWN]
    made.ImagePositionPatient = list(np.round(ORIGIN + number * SLICE * NORMAL, 6))
    made.SamplesPerPixel = 1
    made.PhotometricInterpretation = "MONOCHROME2"
    made.BitsAllocated, made.BitsStored, made.HighBit = 16, 12, 11
    made.PixelRepresentation = 0
    made.PositionReferenceIndicator = ""
    made.PixelData = np.full((ROWS, COLUMNS), 40, np.uint16).tobytes()
    return made


def described(number: int, label: str) -> hd.seg.SegmentDescription:
    """A segment."""
    return hd.seg.SegmentDescription(
        segment_number=number,
        segment_label=label,
        segmented_property_category=codes.SCT.Organ,
        segmented_property_type=codes.SCT.Liver,
        algorithm_type=hd.seg.SegmentAlgorithmTypeValues.MANUAL,
    )


def predicted(rows: np.ndarray, row: int, column: int, predictor: int, restart: bool) -> int:
    """The prediction of a sample [ITU-T T.81, H.1.2.1]."""
    if row == 0 or restart:
        return int(rows[row, column - 1]) if column else 1 << 15
    above = int(rows[row - 1, column])
    if column == 0:
        return above
    left, corner = int(rows[row, column - 1]), int(rows[row - 1, column - 1])
    return [
        left,
        above,
        corner,
        left + above - corner,
        left + ((above - corner) >> 1),
        above + ((left - corner) >> 1),
        (left + above) >> 1,
    ][predictor - 1]


def jpeg(rows: np.ndarray, predictor: int, interval: int) -> bytes:
    """A lossless JPEG stream of 16 bits, with a restart marker after each `interval` rows."""
    # All lengths of differences have codes of five bits.
    table = bytes([0, 0, 0, 0, 17, *[0] * 11, *range(17)])
    size = b"".join(side.to_bytes(2, "big") for side in rows.shape)
    stream = b"\xff\xd8\xff\xc4" + (2 + 1 + len(table)).to_bytes(2, "big") + b"\x00" + table
    stream += b"\xff\xc3\x00\x0b\x10" + size + b"\x01\x01\x11\x00"
    stream += b"\xff\xdd\x00\x04" + (interval * rows.shape[1]).to_bytes(2, "big")
    stream += b"\xff\xda\x00\x08\x01\x01\x00" + bytes([predictor, 0, 0])
    bits = ""

    def flushed(bits: str) -> bytes:
        bits += "1" * (-len(bits) % 8)
        return int("1" + bits, 2).to_bytes(1 + len(bits) // 8, "big")[1:].replace(b"\xff", b"\xff\x00")

    for row in range(rows.shape[0]):
        restart = row > 0 and row % interval == 0
        if restart:
            stream += flushed(bits) + bytes([0xFF, 0xD0 + (row // interval - 1) % 8])
            bits = ""
        for column in range(rows.shape[1]):
            off = (int(rows[row, column]) - predicted(rows, row, column, predictor, restart)) & 0xFFFF
            off = off - 0x10000 if off > 0x8000 else off
            length = abs(off).bit_length()
            bits += f"{length:05b}"
            if 0 < length < 16:
                bits += f"{off if off > 0 else off + (1 << length) - 1:0{length}b}"
    stream += flushed(bits) + b"\xff\xd9"
    return stream


def compressed(made: Dataset, syntax: UID, frames: list[bytes], fragments: int = 1) -> Dataset:
    """The same with compressed frames."""
    made = copy.deepcopy(made)
    made.file_meta.TransferSyntaxUID = syntax
    made.PixelData = encapsulate(frames, fragments_per_frame=fragments)
    made["PixelData"].VR = "OB"
    made["PixelData"].is_undefined_length = True
    return made


def written(made: Dataset, name: str) -> None:
    """Writes a file in a transfer syntax that pydicom 3.0 need not know."""
    made.preamble = bytes(128)
    dcmwrite(HERE / f"{name}.dcm", made, implicit_vr=False, little_endian=True, force_encoding=True)


def compressed_bits(made: Dataset) -> None:
    """A bit for each pixel, compressed by JPEG 2000, by run lengths of a byte for each pixel, and deflated."""
    pixels = made.pixel_array.astype(np.uint8)
    one = {"level": 0, "reversible": True, "codecformat": "j2k", "bitspersample": 1}
    frames = [imagecodecs.jpeg2k_encode(own, **one) for own in pixels]
    written(compressed(made, JPEG2000Lossless, frames), "bits-jpeg2000")
    frames = []
    for own in pixels:
        stream = zlib.compressobj(9, wbits=-15)
        frames.append(stream.compress(np.packbits(own, bitorder="little").tobytes()) + stream.flush())
    written(compressed(made, DeflatedImageFrame, frames), "bits-deflated-frames")
    in_bytes = copy.deepcopy(made)
    in_bytes.BitsAllocated, in_bytes.BitsStored, in_bytes.HighBit = 8, 8, 7
    in_bytes.PixelData = pixels.tobytes()
    in_bytes.compress(RLELossless, generate_instance_uid=False)
    in_bytes.BitsAllocated, in_bytes.BitsStored, in_bytes.HighBit = 1, 1, 0
    in_bytes.save_as(HERE / "bits-rle.dcm", enforce_file_format=True)


def all_kinds(labels: Dataset) -> None:
    """Labels that differ from voxel to voxel, uncompressed and as lossless JPEG of all kinds, by libjpeg-turbo and by
    `jpeg`, with three fragments for each frame."""
    at, rows, columns = np.ogrid[:SLICES, :12, :16]
    voxels = (32768 * ((at + rows + columns) % 2) + 7 * columns * rows + 900 * at + 13).astype(np.uint16)
    voxels += np.random.default_rng(1).integers(0, 400, voxels.shape).astype(np.uint16) ** 2 % 977
    voxels[7] &= 0xFFF
    # A difference of 32768.
    voxels[:, 3, 3:5] = [0, 32768]
    voxels[7, 3, 4] = 1
    labels = copy.deepcopy(labels)
    labels.Rows, labels.Columns = voxels.shape[1:]
    labels.BitsAllocated, labels.BitsStored, labels.HighBit = 16, 16, 15
    labels.PixelData = voxels.tobytes()
    labels["PixelData"].VR = "OW"
    labels.save_as(HERE / "labels16.dcm", enforce_file_format=True)
    frames = [
        imagecodecs.jpeg8_encode(voxels[place], lossless=True, predictor=1 + place, bitspersample=16) for place in range(7)
    ]
    frames.append(imagecodecs.jpeg8_encode(voxels[7], lossless=True, predictor=4, bitspersample=12))
    frames += [jpeg(voxels[8], 5, 2), jpeg(voxels[9], 1, 1)]
    assert all((imagecodecs.jpeg8_decode(frame) == own).all() for frame, own in zip(frames, voxels))
    made = compressed(labels, JPEGLossless, frames, 3)
    made.save_as(HERE / "labels16-jpeg.dcm", enforce_file_format=True)


def segmentation(
    images: list[Dataset],
    number: int,
    kind: hd.seg.SegmentationTypeValues,
    pixels: np.ndarray,
    syntax: UID,
    *,
    omit_empty: bool,
) -> hd.seg.Segmentation:
    """A segmentation object of the series."""
    return hd.seg.Segmentation(
        source_images=images,
        pixel_array=pixels,
        segmentation_type=kind,
        segment_descriptions=[described(1, "liver"), described(2, "tumour")],
        series_instance_uid=f"{root()}.5.{number + 1}",
        series_number=2 + number,
        sop_instance_uid=f"{root()}.6.{number + 1}",
        instance_number=1,
        manufacturer="none",
        manufacturer_model_name="none",
        software_versions="1",
        device_serial_number="1",
        max_fractional_value=255,
        # Frames without a pixel of a segment are left out.
        omit_empty_frames=omit_empty,
        transfer_syntax_uid=syntax,
    )


def main() -> None:
    """Writes the files."""
    images = [image(number) for number in range(SLICES)]
    at = np.stack(np.meshgrid(np.arange(SLICES), np.arange(ROWS), np.arange(COLUMNS), indexing="ij"), axis=-1)
    labels = np.zeros((SLICES, ROWS, COLUMNS), np.uint8)
    for number, ((column, row, piece), radius) in enumerate(BALLS, 1):
        way = (at - np.array([piece, row, column])) * np.array([SLICE, ROW, COLUMN])
        labels[np.linalg.norm(way, axis=-1) <= radius] = number
    parts = np.stack([(labels == 1), (labels == 2)], axis=-1).astype(np.float64)
    kinds = {
        "bits": (hd.seg.SegmentationTypeValues.BINARY, labels),
        # 0.4 where there is nothing of a segment is less than half.
        "parts": (hd.seg.SegmentationTypeValues.FRACTIONAL, np.where(parts > 0, 0.6, 0.4)),
        "labels": (hd.seg.SegmentationTypeValues.LABELMAP, labels),
    }
    kinds |= {f"{name}-rle": kinds[name] for name in ("parts", "labels")}
    images[3].save_as(HERE / "image.dcm", enforce_file_format=True)
    for number, (name, (kind, pixels)) in enumerate(kinds.items()):
        syntax = RLELossless if name.endswith("-rle") else ExplicitVRLittleEndian
        made = segmentation(images, number, kind, pixels, syntax, omit_empty=not name.startswith("parts"))
        made.save_as(HERE / f"{name}.dcm", enforce_file_format=True)
        if name == "bits":
            compressed_bits(made)
        if name == "labels":
            pixels = made.pixel_array
            frames = [imagecodecs.jpeg2k_encode(own, level=0, reversible=True, codecformat="j2k") for own in pixels]
            written(compressed(made, JPEG2000Lossless, frames), "labels-jpeg2000")
            written(compressed(made, JPEGLSLossless, list(map(imagecodecs.jpegls_encode, pixels))), "labels-jpegls")

    def run(*command: object) -> None:
        subprocess.run([str(word) for word in command], check=True)

    run("dcmcjpeg", "+e1", HERE / "labels.dcm", HERE / "labels-jpeg.dcm")
    # Without the lowest bit: one label is lost, the other kept.
    run("dcmcjpeg", "+e1", "+pt", 1, HERE / "labels.dcm", HERE / "labels-transform.dcm")
    run("dcmcjpeg", "+el", "+sv", 6, HERE / "parts.dcm", HERE / "parts-jpeg.dcm")
    run("dcmconv", "+td", HERE / "parts.dcm", HERE / "parts-deflated.dcm")
    run("dcmconv", "+td", HERE / "image.dcm", HERE / "image-deflated.dcm")
    run("dcmcjpeg", "+e1", HERE / "image.dcm", HERE / "image-jpeg.dcm")
    all_kinds(segmentation(images, len(kinds), *kinds["labels"], ExplicitVRLittleEndian, omit_empty=False))
    voxels = [int((labels == number).sum()) for number in (1, 2)]
    print("voxels:", voxels)


if __name__ == "__main__":
    main()
