// The part of UnityEngine that docs/how_to/unity.md uses, to compile its component with.

using System;

namespace UnityEngine
{
    public class MonoBehaviour
    {
        public Transform transform;
        public T GetComponent<T>() { return default(T); }
    }

    public class Transform
    {
        public Vector3 position;
        public Vector3 InverseTransformPoint(Vector3 point) { return point; }
    }

    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }

    public struct Pose { }

    public struct Touch { }

    public class Mesh
    {
        public Rendering.IndexFormat indexFormat;
        public Vector3[] vertices;
        public int[] triangles;
        public void Clear() { }
        public void RecalculateNormals() { }
        public void RecalculateBounds() { }
    }

    public class MeshFilter { public Mesh mesh; }

    public class RequireComponent : Attribute { public RequireComponent(Type type) { } }

    public static class Application { public static string streamingAssetsPath = ""; }

    public static class Time { public static float fixedDeltaTime = 0.005f; }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}
