"""Writes the DICOM files next to it: needs highdicom 0.28 and pydicom 3.

Two balls of known place and radius in an oblique series of ten images of 24 x 20 pixels, as a segmentation with a bit for
each pixel, with a part of 255 for each, and as a map of labels, the last two also compressed; and one of the images,
with a name and a date in it.
"""

from pathlib import Path

import highdicom as hd
import numpy as np
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.sr.codedict import codes
from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian, RLELossless

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
    for number, (name, (kind, pixels)) in enumerate(kinds.items()):
        made = hd.seg.Segmentation(
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
            omit_empty_frames=not name.startswith("parts"),
            transfer_syntax_uid=RLELossless if name.endswith("-rle") else ExplicitVRLittleEndian,
        )
        made.save_as(HERE / f"{name}.dcm", enforce_file_format=True)
    images[3].save_as(HERE / "image.dcm", enforce_file_format=True)
    voxels = [int((labels == number).sum()) for number in (1, 2)]
    print("voxels:", voxels)


if __name__ == "__main__":
    main()
