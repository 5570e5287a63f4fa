//! Arrays across the border: contiguous copies in, fresh read-only arrays out, each with the type it has in the stubs.

use numpy::ndarray::{Array, IxDyn};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyRuntimeError;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{type_hint_identifier, type_hint_subscript};

/// A number type that arrays have, with its name in numpy.
pub(crate) trait Number: Element + Copy {
    const DTYPE: PyStaticExpr;
}

macro_rules! numbers {
    ($($rust:ty => $numpy:literal),*) => {
        $(impl Number for $rust {
            const DTYPE: PyStaticExpr = type_hint_identifier!("numpy", $numpy);
        })*
    };
}
numbers!(f64 => "float64", u8 => "uint8", i8 => "int8", u32 => "uint32", i64 => "int64");

/// One-dimensional input.
pub(crate) struct Values<T>(pub(crate) Vec<T>);

impl<'a, 'py, T: Number> FromPyObject<'a, 'py> for Values<T> {
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr =
        type_hint_subscript!(type_hint_identifier!("numpy.typing", "NDArray"), <T as Number>::DTYPE);

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array: PyReadonlyArray1<'py, T> = object.extract()?;
        Ok(Self(array.as_array().iter().copied().collect()))
    }
}

/// Two-dimensional input, row-major.
pub(crate) struct Table<T> {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    pub(crate) values: Vec<T>,
}

impl<'a, 'py, T: Number> FromPyObject<'a, 'py> for Table<T> {
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr =
        type_hint_subscript!(type_hint_identifier!("numpy.typing", "NDArray"), <T as Number>::DTYPE);

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array: PyReadonlyArray2<'py, T> = object.extract()?;
        let array = array.as_array();
        Ok(Self { rows: array.nrows(), columns: array.ncols(), values: array.iter().copied().collect() })
    }
}

/// An array for Python: row-major values and their shape.
pub(crate) struct Output<T> {
    shape: Vec<usize>,
    values: Vec<T>,
}

impl<T> Output<T> {
    pub(crate) fn new(values: impl IntoIterator<Item = T>) -> Self {
        let values: Vec<T> = values.into_iter().collect();
        Self { shape: vec![values.len()], values }
    }

    /// With a shape, whose product is the number of values.
    pub(crate) fn shaped(shape: &[usize], values: Vec<T>) -> Self {
        Self { shape: shape.to_vec(), values }
    }
}

impl<'py, T: Number> IntoPyObject<'py> for Output<T> {
    type Target = PyArrayDyn<T>;
    type Output = Bound<'py, Self::Target>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr =
        type_hint_subscript!(type_hint_identifier!("numpy.typing", "NDArray"), <T as Number>::DTYPE);

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let array = Array::from_shape_vec(IxDyn(&self.shape), self.values)
            .map_err(|mismatch| PyRuntimeError::new_err(mismatch.to_string()))?;
        let array = PyArrayDyn::from_owned_array(py, array);
        array.readwrite().make_nonwriteable();
        Ok(array)
    }
}

/// An array that Python already holds: handed out again and again, never copied.
pub(crate) struct Kept<T>(Py<PyArrayDyn<T>>);

impl<T: Number> Kept<T> {
    /// The same array once more.
    pub(crate) fn again(&self, py: Python<'_>) -> Self {
        Self(self.0.clone_ref(py))
    }
}

impl<T: Number> Output<T> {
    /// Makes the array now, of the very memory of the values.
    pub(crate) fn keep(self, py: Python<'_>) -> PyResult<Kept<T>> {
        Ok(Kept(self.into_pyobject(py)?.unbind()))
    }
}

impl<'py, T: Number> IntoPyObject<'py> for Kept<T> {
    type Target = PyArrayDyn<T>;
    type Output = Bound<'py, Self::Target>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = <Output<T> as IntoPyObject>::OUTPUT_TYPE;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        Ok(self.0.into_bound(py))
    }
}

/// Numbers by name, in order, as a dictionary.
pub(crate) struct Named<T, const N: usize>(pub(crate) [(&'static str, T); N]);

impl<'py, T: IntoPyObject<'py>, const N: usize> IntoPyObject<'py> for Named<T, N> {
    type Target = PyDict;
    type Output = Bound<'py, PyDict>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = type_hint_subscript!(
        type_hint_identifier!("builtins", "dict"),
        <String as IntoPyObject>::OUTPUT_TYPE,
        T::OUTPUT_TYPE
    );

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let dict = PyDict::new(py);
        for (name, value) in self.0 {
            dict.set_item(name, value)?;
        }
        Ok(dict)
    }
}
